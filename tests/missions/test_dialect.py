"""Where ArduPilot and PX4 differ in what they are given."""

import pytest

from missions.altitude_frame import AltitudeFrame
from missions.autopilot import Autopilot
from missions.commands import Command, Frame
from missions.dialect import in_dialect, wire_items
from missions.errors import InputError
from missions.fence import Fence, FenceCircle, rally_items
from missions.mission import Mission, MissionItem
from missions.vehicle_plan import Plan

HOME = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=465_000_000, lon_e7=113_000_000, alt_m=1200.0)
TAKEOFF = MissionItem(Command.NAV_TAKEOFF, Frame.GLOBAL, 10.0, lat_e7=HOME.lat_e7, lon_e7=HOME.lon_e7, alt_m=1230.0)
FAR = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=465_500_000, lon_e7=113_000_000, alt_m=1500.0)
FENCE = Fence((FenceCircle(False, (465_200_000, 113_400_000), 500.0),))
PLAN = Plan(Mission((HOME, TAKEOFF, FAR)), FENCE, rally_items([(HOME.lat_e7, HOME.lon_e7, 300.0)]))


def level_m(lat_e7: int, lon_e7: int) -> float:
    return 1000.0


def test_ardupilot_gets_all_of_a_plan_as_it_is() -> None:
    assert in_dialect(PLAN, Autopilot.ardupilot, AltitudeFrame.amsl, level_m) == PLAN


@pytest.mark.parametrize("altitude", [AltitudeFrame.amsl, AltitudeFrame.relative])
def test_px4_gets_mission_and_fence_but_no_rally_point_at_home(altitude: AltitudeFrame) -> None:
    plan = in_dialect(PLAN, Autopilot.px4, altitude, level_m)
    assert plan.fence == FENCE
    assert plan.rally == ()
    assert plan.mission[1].lat_e7 > HOME.lat_e7


def test_px4_gets_no_altitudes_above_terrain() -> None:
    with pytest.raises(InputError, match="terrain: PX4 refuses altitudes above terrain"):
        in_dialect(PLAN, Autopilot.px4, AltitudeFrame.terrain, level_m)


def test_home_goes_to_ardupilot_and_not_to_px4() -> None:
    assert wire_items(PLAN.mission, Autopilot.ardupilot) == (HOME, TAKEOFF, FAR)
    assert wire_items(PLAN.mission, Autopilot.px4) == (TAKEOFF, FAR)
