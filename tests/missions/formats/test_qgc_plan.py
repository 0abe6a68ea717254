"""What is true of `.plan` files."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.autopilot import Autopilot
from missions.errors import InputError
from missions.fence import Fence, FenceCircle, FencePolygon, rally_items
from missions.formats.qgc_plan import write_plan
from missions.formats.qgc_plan_reader import read_plan
from missions.mission import Mission, MissionItem
from missions.vehicle_plan import Plan

PARAM = st.floats(width=32, allow_infinity=False)
FINITE = st.floats(width=32, allow_infinity=False, allow_nan=False)
E7 = st.integers(-(2**31) + 1, 2**31 - 1)
ITEMS = st.builds(
    MissionItem, st.integers(0, 65535), st.integers(0, 21), PARAM, PARAM, PARAM, PARAM, E7, E7, FINITE, st.booleans()
)
HOMES = st.builds(lambda lat, lon, alt: MissionItem(16, lat_e7=lat, lon_e7=lon, alt_m=alt), E7, E7, FINITE)
MISSIONS = st.builds(lambda home, items: Mission((home, *items)), HOMES, st.lists(ITEMS, max_size=20))
PLACES = st.tuples(E7, E7)
POLYGONS = st.builds(FencePolygon, st.booleans(), st.lists(PLACES, min_size=3, max_size=6).map(tuple))
CIRCLES = st.builds(FenceCircle, st.booleans(), PLACES, st.floats(1.0, 1e5))
FENCES = st.builds(
    lambda polygons, circles, back: Fence((*polygons, *circles), back),
    st.lists(POLYGONS, max_size=3),
    st.lists(CIRCLES, max_size=3),
    st.none() | PLACES,
)
RALLIES = st.lists(st.tuples(E7, E7, FINITE), max_size=4).map(rally_items)
PLANS = st.builds(Plan, MISSIONS, FENCES, RALLIES)


@given(PLANS)
def test_what_is_written_reads_back_equal(tmp_path_factory: pytest.TempPathFactory, plan: Plan) -> None:
    path = tmp_path_factory.mktemp("plan") / "any.plan"
    write_plan(plan, path, cruise_speed_m_s=25.0)
    assert read_plan(path) == plan


@pytest.fixture
def plan(tmp_path: Path) -> dict[str, Any]:
    """A plan of two items as written, parsed."""
    home = MissionItem(16, lat_e7=465_000_000, lon_e7=113_000_000, alt_m=1200.0)
    items = (
        MissionItem(178, 2, 0.0, 24.5, -1.0),
        MissionItem(16, 0, 0, 50, 0, math.nan, 465_100_000, 113_100_000, 1500),
    )
    path = tmp_path / "two.plan"
    write_plan(Plan(Mission((home, *items))), path, cruise_speed_m_s=24.5)
    return dict(json.loads(path.read_text()))


def test_it_has_all_that_qgroundcontrol_asks_for(plan: dict[str, Any]) -> None:
    assert (plan["fileType"], plan["version"]) == ("Plan", 1)
    assert plan["geoFence"] == {"version": 2, "circles": [], "polygons": []}
    assert plan["rallyPoints"] == {"version": 2, "points": []}
    mission = plan["mission"]
    assert (mission["version"], mission["firmwareType"], mission["vehicleType"]) == (2, 3, 1)
    assert mission["plannedHomePosition"] == [46.5, 11.3, 1200.0]
    assert [item["doJumpId"] for item in mission["items"]] == [1, 2]
    assert mission["items"][1]["params"] == [0.0, 50.0, 0.0, None, 46.51, 11.31, 1500.0]


ALTITUDE_KEYS = {"AltitudeMode", "Altitude", "AMSLAltAboveTerrain"}


@pytest.mark.parametrize(("frame", "mode"), [(3, 1), (0, 2), (10, 4)])
def test_items_with_a_place_say_qgroundcontrol_s_altitude_mode_and_others_nothing_of_it(
    tmp_path: Path, frame: int, mode: int
) -> None:
    items = (MissionItem(178, 2, 0.0, 24.5, -1.0), MissionItem(16, frame, lat_e7=1, lon_e7=2, alt_m=150.5))
    path = tmp_path / "any.plan"
    write_plan(Plan(Mission((MissionItem(16), *items))), path, cruise_speed_m_s=24.5)
    mission = json.loads(path.read_text())["mission"]
    speed, waypoint = mission["items"]
    assert not ALTITUDE_KEYS & speed.keys()
    assert {key: waypoint[key] for key in ALTITUDE_KEYS} == {
        "AltitudeMode": mode,
        "Altitude": 150.5,
        "AMSLAltAboveTerrain": None,
    }
    assert mission["globalPlanAltitudeMode"] == mode


def test_a_plan_of_two_frames_is_of_mixed_altitudes(tmp_path: Path) -> None:
    path = tmp_path / "any.plan"
    write_plan(Plan(Mission((MissionItem(16), MissionItem(22, 3), MissionItem(16, 10)))), path, cruise_speed_m_s=24.5)
    assert json.loads(path.read_text())["mission"]["globalPlanAltitudeMode"] == 0


def test_a_plan_for_px4_says_so(tmp_path: Path) -> None:
    path = tmp_path / "any.plan"
    write_plan(Plan(Mission((MissionItem(16),))), path, cruise_speed_m_s=24.5, autopilot=Autopilot.px4)
    assert json.loads(path.read_text())["mission"]["firmwareType"] == 12


def _set(*keys: Any, to: Any) -> Callable[[dict[str, Any]], None]:
    def change(plan: dict[str, Any]) -> None:
        place: Any = plan
        for key in keys[:-1]:
            place = place[key]
        place[keys[-1]] = to

    return change


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (_set("fileType", to="Mission"), "fileType: must be 'Plan', got 'Mission'"),
        (_set("mission", to=[]), "mission: must be an object, got []"),
        (_set("mission", "items", to=None), "mission.items: must be an array, got null"),
        (_set("mission", "items", 1, "params", to=[0.0]), "mission.items[1].params: must have 7 numbers, got 1"),
        (
            _set("mission", "items", 1, "params", 4, to="x"),
            'mission.items[1].params[4]: must be a number or null, got "x"',
        ),
        (_set("mission", "items", 1, "params", 4, to=1e9), "mission.items[1].params[4]: must be degrees, got 1e+09"),
        (_set("mission", "items", 0, "command", to=16.5), "mission.items[0].command: must be a whole number, got 16.5"),
        (
            _set("mission", "items", 0, to={"type": "ComplexItem", "complexItemType": "survey"}),
            "mission.items[0]: ComplexItem 'survey' cannot be read",
        ),
        (_set("geoFence", "circles", to=[{}]), "geoFence.circles[0].circle: must be an object, got null"),
        (
            _set("geoFence", "circles", to=[{"circle": {"center": [1, 2], "radius": -5}}]),
            "geoFence.circles[0].circle.radius: must be > 0, got -5",
        ),
        (
            _set("geoFence", "polygons", to=[{"inclusion": True, "polygon": [[1, 2], [3, 4]]}]),
            "geoFence.polygons[0].polygon: must have at least 3 corners, got 2",
        ),
        (
            _set("geoFence", "polygons", to=[{"polygon": [[1, 2], [3, 4], [5, 6]]}]),
            "geoFence.polygons[0].inclusion: must be true or false",
        ),
        (_set("rallyPoints", "points", to=[[1, 2]]), "rallyPoints.points[0]: must have 3 numbers, got 2"),
        (_set("rallyPoints", "points", to=[[1, 2, None]]), "rallyPoints.points[0][2]: must be a number, got NaN"),
    ],
)
def test_errors_name_the_file_and_the_place_in_it(
    plan: dict[str, Any], tmp_path: Path, change: Callable[[dict[str, Any]], None], reason: str
) -> None:
    change(plan)
    path = tmp_path / "bad.plan"
    path.write_text(json.dumps(plan))
    with pytest.raises(InputError) as error:
        read_plan(path)
    assert str(error.value).startswith(f"{path}: {reason}")


def test_a_file_that_is_no_json_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "bad.plan"
    path.write_text("{\n  oops")
    with pytest.raises(InputError, match="line 2: not JSON"):
        read_plan(path)


def test_a_home_that_the_format_cannot_hold_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="item 0: home"):
        write_plan(Plan(Mission((MissionItem(22),))), tmp_path / "any.plan", cruise_speed_m_s=25.0)


def test_a_folder_that_cannot_be_written_to_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="choose a folder"):
        write_plan(Plan(Mission((MissionItem(16),))), tmp_path / "missing" / "any.plan", cruise_speed_m_s=25.0)
