"""What the parameters of a vehicle forbid of a plan."""

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from gcs.check.flight import planned_flight
from gcs.check.held import VehicleLimits, forbidden
from missions.autopilot import Autopilot
from missions.commands import Command
from missions.fence import NO_FENCE, Fence, FenceCircle, rally_items
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario
from missions.vehicle_plan import Plan

Place = Callable[..., MissionItem]
SPEED = MissionItem(Command.DO_CHANGE_SPEED, 2, 0.0, 30.0, -1.0)
WITH_FENCE = {"FENCE_ENABLE": 1.0, "FENCE_TYPE": 15.0}


@pytest.mark.parametrize(
    ("parameters", "fenced", "told"),
    [
        ({"AIRSPEED_MAX": 28.0}, False, [(1, "airspeed that the vehicle ignores", "AIRSPEED_MAX 28")]),
        ({"ARSPD_FBW_MIN": 31.0}, False, [(1, "airspeed that the vehicle ignores", "ARSPD_FBW_MIN 31")]),
        ({"WP_RADIUS": 500.0}, False, [(3, "leg within the acceptance radius", "WP_RADIUS 500")]),
        ({"FENCE_ENABLE": 0.0, "FENCE_TYPE": 4.0}, True, [(None, "the fence would not be heeded", "1 and the bit 4")]),
        (WITH_FENCE | {"FENCE_ALT_MAX": 110.0}, True, [(3, "height above home", "FENCE_ALT_MAX 110")]),
        (WITH_FENCE | {"FENCE_RADIUS": 1300.0}, True, [(3, "distance from home", "FENCE_RADIUS 1300")]),
        (WITH_FENCE | {"FENCE_ALT_MIN": 20.0}, True, []),
        ({"FENCE_ENABLE": 0.0, "FENCE_ALT_MAX": 10.0, "FENCE_TYPE": 15.0}, False, []),
        ({"AIRSPEED_MIN": 20.0, "AIRSPEED_MAX": 35.0, "WP_RADIUS": 90.0}, False, []),
    ],
)
def test_limits_are_named_with_the_item_that_breaks_them_and_the_parameter(
    calm: Scenario,
    home: MissionItem,
    place: Place,
    parameters: Mapping[str, float],
    fenced: bool,
    told: list[tuple[int | None, str, str]],
) -> None:
    way = (SPEED, place(Command.NAV_WAYPOINT, 1200, 0, 100), place(Command.NAV_WAYPOINT, 1500, 300, 120))
    fence = Fence((FenceCircle(True, (home.lat_e7, home.lon_e7), 9000.0),)) if fenced else NO_FENCE
    plan = Plan(Mission((home, *way)), fence)
    problems = list(forbidden(Path("one.plan"), plan, planned_flight(plan, calm), VehicleLimits(parameters), calm))
    assert [(problem.item, problem.what, problem.limit) for problem in problems] == told


@pytest.mark.parametrize(
    ("autopilot", "room", "too_many"),
    [(Autopilot.ardupilot, 3, []), (Autopilot.ardupilot, 2, ["3"]), (Autopilot.px4, 2, []), (Autopilot.px4, 1, ["2"])],
)
def test_more_items_than_the_vehicle_takes_are_counted_as_its_autopilot_counts_them(
    calm: Scenario, home: MissionItem, place: Place, autopilot: Autopilot, room: int, too_many: list[str]
) -> None:
    plan = Plan(Mission((home, place(Command.NAV_WAYPOINT, 1200, 0, 100), place(Command.NAV_WAYPOINT, 1500, 300, 120))))
    vehicle = VehicleLimits({}, {PlanType.MISSION: room, PlanType.FENCE: 0, PlanType.RALLY: 0}, autopilot)
    problems = list(forbidden(Path("one.plan"), plan, None, vehicle, calm))
    assert [problem.value for problem in problems] == too_many
    assert {(problem.what, problem.limit) for problem in problems} <= {
        ("more mission items than the vehicle takes", str(room))
    }


@pytest.mark.parametrize(("action", "told"), [(0.0, ["GF_ACTION 0"]), (2.0, [])])
def test_a_px4_heeds_fences_by_another_parameter(
    calm: Scenario, home: MissionItem, place: Place, action: float, told: list[str]
) -> None:
    fence = Fence((FenceCircle(True, (home.lat_e7, home.lon_e7), 9000.0),))
    plan = Plan(Mission((home, place(Command.NAV_WAYPOINT, 1200, 0, 100))), fence)
    vehicle = VehicleLimits({"GF_ACTION": action}, autopilot=Autopilot.px4)
    assert [problem.value for problem in forbidden(Path("one.plan"), plan, None, vehicle, calm)] == told


@pytest.mark.parametrize(("limit_km", "told"), [(1.0, [3]), (2.0, []), (0.0, [])])
def test_a_rally_point_beyond_those_that_count_is_told(
    calm: Scenario, home: MissionItem, place: Place, limit_km: float, told: list[int]
) -> None:
    way = (SPEED, place(Command.NAV_WAYPOINT, 1200, 0, 100), place(Command.NAV_WAYPOINT, 1500, 300, 120))
    plan = Plan(Mission((home, *way)), rally=rally_items([(home.lat_e7, home.lon_e7, 200.0)]))
    vehicle = VehicleLimits({"RALLY_LIMIT_KM": limit_km})
    problems = list(forbidden(Path("one.plan"), plan, planned_flight(plan, calm), vehicle, calm))
    assert [problem.item for problem in problems] == told
    assert all(problem.what == "rally point that does not count" for problem in problems)
