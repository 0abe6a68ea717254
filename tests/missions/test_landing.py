"""A landing comes down clear of ground, obstacles and other vehicles, no steeper than both autopilots take."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.environment import ground_heights_m
from missions.errors import InputError
from missions.landing import APPROACH_HEIGHT_M, GLIDE_SLOPE, LEVEL_WITHIN_M, STEP_M, Landing, landings, with_landing
from missions.mission import Mission, MissionItem
from missions.px4 import px4_mission
from missions.scenario import Scenario, load_scenario

RADIUS_M = 110.0


def loitering(scenario: Scenario, radius_m: float = RADIUS_M) -> dict[int, Mission]:
    """Missions from each vehicle's origin straight to a loiter at its target."""
    frame = scenario.frame

    def at(command: Command, point_m: tuple[float, float, float], param3: float = 0.0) -> MissionItem:
        lat_e7, lon_e7 = frame.to_e7(*point_m[:2])
        alt_m = point_m[2] + frame.alt_m
        return MissionItem(command, Frame.GLOBAL, param3=param3, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)

    return {
        vehicle.sysid: Mission(
            (
                at(Command.NAV_WAYPOINT, scenario.origin_m(vehicle)),
                at(Command.NAV_WAYPOINT, scenario.target_m(vehicle)),
                at(Command.NAV_LOITER_UNLIM, scenario.target_m(vehicle), radius_m),
            )
        )
        for vehicle in scenario.vehicles
    }


def changed(scenario: Scenario, **tables: Any) -> Scenario:
    return Scenario.model_validate({**scenario.model_dump(), **tables})


HILLS = [
    {"height_m": 250.0, "x_m": x_m, "y_m": y_m, "decline_x_m": 3000.0, "decline_y_m": 3000.0}
    for x_m, y_m in ((26_000.0, 21_000.0), (23_000.0, 14_500.0))
]


@pytest.fixture(scope="module", params=["flat", "hilly"])
def scenario(request: pytest.FixtureRequest) -> Scenario:
    radars = load_scenario("radars")
    return radars if request.param == "flat" else changed(radars, terrain={"peaks": HILLS})


@pytest.fixture(scope="module")
def found(scenario: Scenario) -> dict[int, Landing]:
    return landings(scenario, loitering(scenario))


def test_the_final_leaves_the_circle_along_its_tangent(found: dict[int, Landing]) -> None:
    for landing in found.values():
        outward = landing.final_m[0] - landing.centre_m
        along = landing.final_m[-1] - landing.final_m[0]
        assert math.hypot(*outward) == pytest.approx(RADIUS_M)
        assert outward @ along == pytest.approx(0.0, abs=1e-6)
        assert outward[0] * along[1] - outward[1] * along[0] < 0.0  # clockwise: the centre is to the right


def test_it_glides_no_steeper_than_four_degrees_and_ends_on_level_ground(
    scenario: Scenario, found: dict[int, Landing]
) -> None:
    for landing in found.values():
        final = landing.final_m
        assert landing.altitude_m - landing.ground_m <= GLIDE_SLOPE * math.dist(final[0], final[-1]) + 1e-6
        direction = (final[-1] - final[0]) / math.dist(final[0], final[-1])
        runway = final[-1] + np.arange(0.0, 150.0, STEP_M)[:, np.newaxis] * direction
        heights = ground_heights_m(runway[:, 0], runway[:, 1], scenario.environment.terrain)
        assert np.abs(heights - landing.ground_m).max() <= LEVEL_WITHIN_M


def test_circle_and_final_stay_above_the_ground(scenario: Scenario, found: dict[int, Landing]) -> None:
    for landing in found.values():
        way = landing.way_m()
        clearance = way[:, 2] - ground_heights_m(way[:, 0], way[:, 1], scenario.environment.terrain)
        circle = clearance[: -len(landing.final_m)]
        assert circle.min() >= APPROACH_HEIGHT_M - 0.5
        assert clearance.min() >= -LEVEL_WITHIN_M


def test_finals_and_circles_of_different_vehicles_keep_their_separation(
    scenario: Scenario, found: dict[int, Landing]
) -> None:
    apart_m = scenario.limits.separation_m
    for a, b in itertools.permutations(found.values(), 2):
        assert np.linalg.norm(a.final_m[:, np.newaxis] - b.final_m, axis=-1).min() >= apart_m
        assert np.linalg.norm(a.final_m - b.centre_m, axis=-1).min() >= apart_m + RADIUS_M


def test_px4_takes_it_and_the_mission_up_to_its_loiter_stays(scenario: Scenario, found: dict[int, Landing]) -> None:
    for sysid, mission in loitering(scenario).items():
        landed = with_landing(mission, found[sysid], scenario.frame)
        assert landed.items[:-2] == mission.items[:-1]
        assert [item.command for item in landed.items[-2:]] == [Command.NAV_LOITER_TO_ALT, Command.NAV_LAND]
        assert landed[-2].param2 == RADIUS_M
        px4_mission(landed)


def test_against_the_forecast_wind_comes_before_with_it() -> None:
    scenario = changed(load_scenario("radars"), wind={"forecast_m_s": (0.0, 6.0), "steady_m_s": (0.0, 6.0)})
    for landing in landings(scenario, loitering(scenario)).values():
        assert landing.final_m[-1, 1] <= landing.final_m[0, 1] + 1e-6


def test_a_circle_that_turns_the_other_way_is_left_on_its_other_side() -> None:
    scenario = load_scenario("radars")
    for landing in landings(scenario, loitering(scenario, -RADIUS_M)).values():
        outward = landing.final_m[0] - landing.centre_m
        along = landing.final_m[-1] - landing.final_m[0]
        assert outward[0] * along[1] - outward[1] * along[0] > 0.0


def test_an_obstacle_stands_beside_no_final() -> None:
    scenario = load_scenario("radars")
    x, y, _ = scenario.target_m(scenario.vehicles[0])
    wall = {"radius_m": 300.0, "height_m": 200.0, "y_m": y}
    scenario = changed(scenario, obstacles=[{"x_m": x + 700.0, **wall}, {"x_m": x - 700.0, **wall}])
    found = landings(scenario, loitering(scenario))[1]
    for obstacle in scenario.environment.obstacles:
        gaps = np.hypot(found.final_m[:, 0] - obstacle.x_m, found.final_m[:, 1] - obstacle.y_m)
        assert gaps.min() >= obstacle.radius_m + scenario.limits.obstacle_margin_m


def test_circles_that_meet_have_no_landings_at_once() -> None:
    scenario = load_scenario("vee")
    with pytest.raises(InputError, match="vehicle 1: its circle is nearer than"):
        landings(scenario, loitering(scenario))


def test_steep_ground_everywhere_has_no_landing() -> None:
    scenario = load_scenario("radars")
    peak = {"height_m": 3000.0, "x_m": 20000.0, "y_m": 16000.0, "decline_x_m": 9000.0, "decline_y_m": 9000.0}
    slope = changed(scenario, terrain={"peaks": [peak]}, obstacles=[])
    with pytest.raises(InputError, match=r"vehicle \d: no level ground within 4 km of its target"):
        landings(slope, loitering(slope))


def test_a_mission_without_a_loiter_has_none_to_land_from() -> None:
    scenario = load_scenario("radars")
    missions = {1: Mission(loitering(scenario)[1].items[:-1])}
    with pytest.raises(InputError, match="vehicle 1: its mission does not end in a loiter"):
        landings(scenario, missions)
