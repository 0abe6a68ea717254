from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from gcs.figures import draw_all, draw_arms, draw_heights, draw_mission_files, draw_plan_views, draw_scene
from gcs.figures.heights import profile
from gcs.figures.style import DPI, WIDTH_IN, vehicle_colours, vehicle_handles
from gcs.flight_record import FlightRecord
from gcs.metrics import measure
from gcs.vehicle_plans import vehicle_plans
from missions.reference import Reference
from missions.scenario import Scenario, load_scenario
from missions.vehicle_plan import Plan
from planner.formation_plan import FormationPlan
from sitl.formation.graph import edges

Fly = Callable[[dict[int, Reference]], dict[int, np.ndarray]]
Draw = Callable[..., list[Path]]


@pytest.fixture
def draw(
    tmp_path: Path,
    straight_plan: Callable[[Scenario], FormationPlan],
    fly_exactly: Fly,
    make_record: Callable[..., FlightRecord],
) -> Draw:
    """Draws all pictures of a flight as planned, in which a vehicle may be lost."""

    def run(scenario: Scenario, lost: int | None = None) -> list[Path]:
        plan = straight_plan(scenario)
        truths = fly_exactly(plan.references(scenario))
        if lost is not None:
            truths[lost] = truths[lost][:9000]
        graph = edges("ring", list(truths))
        _, series = measure(scenario, plan, truths, graph, make_record(plan))
        return draw_all(scenario, plan, truths, series, tmp_path)

    return run


def assert_shows_something(path: Path) -> None:
    pixels = imread(path)[..., :3]
    assert pixels.shape[1] == WIDTH_IN * DPI
    assert pixels.std() > 0.03
    # Neither the left nor the right edge is drawn on: nothing is cut.
    assert pixels[:, :2].std() < 0.01
    assert pixels[:, -2:].std() < 0.01


@pytest.mark.parametrize("name", ["radars", "mountains"])
def test_every_picture_of_a_flight_shows_something(name: str, draw: Draw) -> None:
    files = draw(load_scenario(name))
    names = {"scene.png", "plan_views.png", "formation.png", "schedule.png", "convergence.png"}
    assert {file.name for file in files} == names
    for file in files:
        assert_shows_something(file)


def test_one_vehicle_has_no_formation_to_show(
    radars: Scenario, few: Callable[[Scenario, int], Scenario], draw: Draw
) -> None:
    files = draw(few(radars, 1))
    assert "formation.png" not in {file.name for file in files}
    for file in files:
        assert_shows_something(file)


def test_a_lost_vehicle_is_shown_as_far_as_it_came(
    radars: Scenario, few: Callable[[Scenario, int], Scenario], draw: Draw
) -> None:
    for file in draw(few(radars, 2), lost=2):
        assert_shows_something(file)


def test_a_plan_can_be_shown_before_it_is_flown(
    tmp_path: Path, radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan]
) -> None:
    for draw_one in (draw_scene, draw_plan_views):
        draw_one(straight_plan(radars), radars, None, tmp_path / "plan.png")
        assert_shows_something(tmp_path / "plan.png")


def test_heights_are_drawn_of_one_of_several_and_of_many(
    tmp_path: Path,
    radars: Scenario,
    few: Callable[[Scenario, int], Scenario],
    straight_plan: Callable[[Scenario], FormationPlan],
) -> None:
    for count in (1, 4, 9):
        scenario = few(radars, count)
        draw_heights(straight_plan(scenario), scenario, tmp_path / "heights.png")
        assert_shows_something(tmp_path / "heights.png")


def test_a_profile_tells_the_least_clearance_after_the_climb_out(
    radars: Scenario, few: Callable[[Scenario, int], Scenario], straight_plan: Callable[[Scenario], FormationPlan]
) -> None:
    scenario = few(radars, 1)
    (reference,) = straight_plan(scenario).references(scenario).values()
    one = profile(reference, scenario)
    # Level ground and an even climb: the least is where the climb-out ends.
    at_end = np.interp(scenario.limits.climb_out_m, one.s_m, one.way_m - one.ground_m)
    assert one.clearance_m == pytest.approx(at_end, abs=1.0)
    assert (one.lowest_m - one.ground_m).max() == scenario.limits.clearance_m


def test_mission_files_are_drawn_with_fences_and_rally_points(
    tmp_path: Path, radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan]
) -> None:
    plans = {f"{one.sysid}-{one.name}": one.plan for one in vehicle_plans(radars, straight_plan(radars))}
    draw_mission_files(plans, radars, tmp_path / "missions.png")
    assert_shows_something(tmp_path / "missions.png")
    before = imread(tmp_path / "missions.png")
    bare = {name: Plan(plan.mission) for name, plan in plans.items()}
    draw_mission_files(bare, radars, tmp_path / "missions.png")
    after = imread(tmp_path / "missions.png")
    assert before.shape != after.shape or not np.array_equal(before, after)


def test_arms_are_compared_in_one_picture(
    tmp_path: Path,
    radars: Scenario,
    few: Callable[[Scenario, int], Scenario],
    straight_plan: Callable[[Scenario], FormationPlan],
    fly_exactly: Fly,
    make_record: Callable[..., FlightRecord],
) -> None:
    scenario = few(radars, 2)
    plan = straight_plan(scenario)
    exact = fly_exactly(plan.references(scenario))
    errors = {}
    for arm, offset_m in (("plain", 90.0), ("own_schedule", 3.0), ("full", 0.5)):
        truths = exact | {2: exact[2] + [offset_m, 0.0, 0.0, 0.0, 0.0, 0.0]}
        _, series = measure(scenario, plan, truths, ((1, 2),), make_record(plan, arm=arm))
        errors[arm] = series.error
    draw_arms(scenario, errors, tmp_path / "arms.png")
    assert_shows_something(tmp_path / "arms.png")


def test_a_vehicle_has_one_colour_and_no_two_share_it(radars: Scenario) -> None:
    colours = vehicle_colours(radars)
    assert len(set(colours.values())) == 9
    assert [handle.get_color() for handle in vehicle_handles(radars)] == list(colours.values())


def test_a_legend_of_many_names_some(radars: Scenario) -> None:
    vehicles = tuple(
        radars.vehicles[0].model_copy(update={"sysid": sysid, "name": f"v{sysid}"}) for sysid in range(1, 51)
    )
    many = radars.model_copy(update={"vehicles": vehicles})
    assert len(set(vehicle_colours(many).values())) == 50
    assert len(vehicle_handles(many)) <= 20
