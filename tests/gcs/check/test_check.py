"""What `skein check` says of mission files, as a user sees it."""

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from gcs.cli import app
from gcs.run_folder import RunFolder
from missions.commands import Command
from missions.fence import NO_FENCE, Fence, FenceCircle
from missions.formats.qgc_plan import write_plan
from missions.mission import Mission, MissionItem
from missions.scenario import Scenario, load_scenario, read_scenario_text
from missions.vehicle_plan import Plan
from planner.plan import plan

Place = Callable[..., MissionItem]
Write = Callable[..., Path]
WAYPOINT = Command.NAV_WAYPOINT


@pytest.fixture
def write(tmp_path: Path, home: MissionItem) -> Write:
    """Write a .plan file of these items."""

    def make(
        items: Sequence[MissionItem], name: str = "one", fence: Fence = NO_FENCE, home: MissionItem = home
    ) -> Path:
        path = tmp_path / f"{name}.plan"
        write_plan(Plan(Mission((home, *items)), fence), path, cruise_speed_m_s=28.0)
        return path

    return make


def check(*arguments: object, code: int) -> list[Any]:
    """The problems that a check finds, as (file, item, what, value, limit)."""
    result = CliRunner().invoke(app, ["check", *map(str, arguments), "--json"])
    assert result.exit_code == code, result.output
    problems = json.loads(result.stdout)["problems"]
    return [
        (Path(one["file"]).stem, one["item"], *(one[key] for key in ("what", "value", "limit"))) for one in problems
    ]


def test_a_mission_that_can_be_flown_has_no_problems(write: Write, place: Place) -> None:
    way = [place(WAYPOINT, 1500, 0, 100), place(WAYPOINT, 3000, 800, 120), place(Command.NAV_RETURN_TO_LAUNCH)]
    assert check(write(way), "--endurance", 30, "--range", 20, code=0) == []


@pytest.mark.parametrize(
    ("way", "item", "what", "limit"),
    [
        ([(1000, 0, 400)], 1, "climb angle", "8 deg"),
        ([(2000, 0, 400), (2600, 0, 100)], 2, "descent angle", "8 deg"),
        ([(2000, 0, 600)], 1, "power for a climb", "100%"),
        (
            [(1000, 0, 100), (1040, 0, 100), (1040, 40, 100), (1080, 40, 100), (3000, 40, 100)],
            3,
            "bank in a turn",
            "45 deg",
        ),
    ],
)
def test_what_the_aircraft_cannot_fly_is_said_with_item_value_and_limit(
    write: Write, place: Place, way: Any, item: int, what: str, limit: str
) -> None:
    problems = check(write([place(WAYPOINT, *point) for point in way]), code=1)
    (found,) = (problem for problem in problems if problem[2] == what)
    assert (found[0], found[1], found[4]) == ("one", item, limit)


def test_leaving_an_area_to_stay_in_and_entering_one_to_stay_out_of_are_said(
    write: Write, place: Place, calm: Scenario
) -> None:
    fence = Fence(
        (FenceCircle(True, calm.frame.to_e7(0, 0), 2000.0), FenceCircle(False, calm.frame.to_e7(1000, 100), 200.0))
    )
    problems = check(write([place(WAYPOINT, 3000, 0, 100)], fence=fence), code=1)
    assert [(item, what) for _, item, what, _, _ in problems] == [
        (1, "outside fence area 1, a circle to stay in"),
        (1, "inside fence area 2, a circle to stay out of"),
    ]
    assert problems[1][3] == "by 100 m"


def test_two_files_flown_at_once_must_keep_apart(write: Write, place: Place, calm: Scenario, home: MissionItem) -> None:
    there = write([place(WAYPOINT, 4000, 0, 100)], "there")
    lat_e7, lon_e7 = calm.frame.to_e7(4000, 50)
    away = MissionItem(WAYPOINT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=home.alt_m)
    back = write([place(WAYPOINT, 0, 50, 100)], "back", home=away)
    assert check(there, code=0) == check(back, code=0) == []
    ((file, item, what, value, limit),) = check(there, back, code=1)
    assert (file, item, limit) == ("back", 1, "75 m")
    assert what.startswith("distance from there.plan after 7")
    assert value == "50 m"


def test_a_flight_longer_than_the_fuel_lasts_is_said(write: Write, place: Place) -> None:
    problems = check(write([place(WAYPOINT, 6000, 0, 100)]), "--endurance", 2, "--range", 5, code=1)
    assert [(what, limit) for _, _, what, _, limit in problems] == [
        ("time of flight", "2 min"),
        ("distance flown", "5 km"),
    ]


def test_items_that_endpoints_do_not_fly_are_named(write: Write, place: Place) -> None:
    above_ground = MissionItem(WAYPOINT, 10, lat_e7=474_000_000, lon_e7=85_100_000, alt_m=100.0)
    problems = check(write([place(WAYPOINT, 900, 0, 90), MissionItem(203, 2), above_ground]), code=1)
    assert [problem[1:3] for problem in problems] == [
        (2, "not flown here: DO_DIGICAM_CONTROL (203) is not for a mission here"),
        (3, "not flown here: NAV_WAYPOINT (16) in frame 10; use 0 or 3"),
    ]


def test_a_landing_that_cannot_be_flown_is_named(write: Write, place: Place) -> None:
    ((_, item, what, _, _),) = check(write([place(WAYPOINT, 1000, 0, 300), place(Command.NAV_LAND, 2000)]), code=1)
    assert item == 2
    assert what.startswith("not flown here: LAND: 300 m to lose")


def test_ground_area_legs_and_turns_are_those_of_a_scenario(write: Write) -> None:
    scenario = load_scenario("mountains")
    peak = max(scenario.terrain.peaks, key=lambda one: one.height_m)

    def item(x: float, y: float, z: float) -> MissionItem:
        lat_e7, lon_e7 = scenario.frame.to_e7(x, y)
        return MissionItem(WAYPOINT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z + scenario.frame.alt_m)

    start = scenario.origin_m(scenario.vehicles[0])
    x, y = peak.x_m, peak.y_m
    east, north = (400.0 * away / math.dist((x, y), start[:2]) for away in (y - start[1], start[0] - x))
    way = [item(x, y, 200.0), item(x + east, y + north, 200.0), item(x + 1.2 * east, y + 1.2 * north, 200.0)]
    problems = check(write(way, home=item(*start)), "--scenario", "mountains", code=1)
    assert {"height above ground", "leg length", "turn"} <= {what for _, _, what, _, _ in problems}


def test_what_skein_has_planned_passes(tmp_path: Path) -> None:
    vee = load_scenario("vee")
    RunFolder(tmp_path).write_plan(read_scenario_text("vee")[0], vee, plan(vee))
    files = sorted((tmp_path / "missions").glob("*.plan"))
    assert len(files) == len(vee.vehicles)
    assert check(*files, "--scenario", "vee", code=0) == []


def test_the_table_fits_80_columns_and_says_what_was_not_checked(
    write: Write, place: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    path = write([place(WAYPOINT, 1000, 0, 400)], "a_mission_with_quite_a_long_name_of_its_own")
    result = CliRunner().invoke(app, ["check", str(path)])
    assert result.exit_code == 1
    lines = result.stdout.splitlines()
    assert all(len(line) <= 80 for line in lines if not line.startswith("Not checked"))
    assert any(line.startswith("Not checked: height above ground") for line in lines)


def test_a_scenario_has_its_own_ground_and_airframe(write: Write, place: Place) -> None:
    path = write([place(WAYPOINT, 1000, 0, 100)])
    result = CliRunner().invoke(app, ["check", str(path), "--scenario", "vee", "--airframe", "ridge"])
    assert result.exit_code == 2
    assert "leave --airframe and --terrain out" in result.stderr
