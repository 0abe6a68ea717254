"""Two references become one without a jump, and neither changes where it is still, or already, flown."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem
from missions.reference import Reference, build_reference, spliced
from missions.scenario import load_scenario

SCENARIO = load_scenario("radars")
FRAME, AIRFRAME = SCENARIO.frame, SCENARIO.airframe.airframe()
WIND = (-2.0, 1.0)
RADIUS_M = 250.0


def route(left_m: float, z_m: float, speed_m_s: float) -> Reference:
    """Two legs of 4 km with a turn to the left, displaced to the left of the first; then a loiter."""

    def item(command: int, x: float, y: float, z: float) -> MissionItem:
        lat_e7, lon_e7 = FRAME.to_e7(x, y + left_m)
        return MissionItem(command, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z + z_m + FRAME.alt_m)

    speed = MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 1, speed_m_s, -1)
    corners = ((4000, 0, 200), (7000, 2600, 200))
    items = [item(Command.NAV_WAYPOINT, 0, 0, 0), speed, *(item(Command.NAV_WAYPOINT, *at) for at in corners)]
    mission = Mission((*items, item(Command.NAV_LOITER_UNLIM, *corners[-1])))
    return build_reference(mission, FRAME, AIRFRAME, WIND)


OWN = route(0.0, 0.0, 26.0)


@settings(max_examples=40)
@given(
    left_m=st.floats(-600.0, 600.0),
    z_m=st.floats(-60.0, 60.0),
    speed_m_s=st.floats(24.0, 28.0),
    start_s=st.floats(15.0, 60.0),
    takes_s=st.floats(30.0, 60.0),
)
def test_it_is_the_one_before_and_the_other_after_and_moves_smoothly_between(
    left_m: float, z_m: float, speed_m_s: float, start_s: float, takes_s: float
) -> None:
    other, end_s = route(left_m, z_m, speed_m_s), start_s + takes_s
    joined = spliced(OWN, other, start_s, end_s, RADIUS_M, WIND)
    before, after = np.arange(0.0, start_s - 10.0, 0.5), np.arange(end_s + 10.0, other.duration_s, 0.5)
    assert np.array_equal(joined.positions(before), OWN.positions(before))
    assert joined.positions(after) == pytest.approx(other.positions(after), abs=1e-6)
    assert joined.duration_s == other.duration_s
    t_s = np.arange(0.0, joined.duration_s, 0.05)
    velocity = np.diff(joined.positions(t_s), axis=0) / 0.05
    turning = np.abs(np.diff(velocity, axis=0)).max() / 0.05
    fastest = np.linalg.norm(velocity, axis=1).max()
    assert turning < 1.1 * fastest**2 / RADIUS_M + 2.0, "an arc's acceleration, and no jump"
    way = other.positions(np.array(end_s)) - OWN.positions(np.array(start_s))
    middle = joined.positions(np.array((start_s + end_s) / 2)) - OWN.positions(np.array(start_s))
    assert middle == pytest.approx(way / 2, abs=2.0), "halfway at half time"


def test_its_corners_have_the_items_that_come_next_and_its_leg_an_airspeed_of_its_own() -> None:
    other = route(120.0, 0.0, 26.0)
    joined = spliced(OWN, other, 40.0, 80.0, RADIUS_M, (0.0, 0.0))
    assert joined.corner_seq == (0, 2, 2, *other.corner_seq[1:])
    assert joined.corner_time_s[1:3].tolist() == [40.0, 80.0]
    assert len(joined.leg_airspeed_m_s) == len(joined.corner_seq) - 1
    expected = math.hypot(26.0, 120.0 / 40.0) * math.hypot(1.0, float(joined.leg_slope[1]))
    assert joined.leg_airspeed_m_s[1] == pytest.approx(expected, rel=1e-2)
    starts = [row[0] for row in joined.tables().airspeeds]
    assert starts == joined.path.corner_s_m[:-1].tolist()


@pytest.mark.parametrize(
    ("start_s", "end_s", "why"),
    [
        (154.0, 200.0, "turning"),
        (100.0, 154.0, "turning"),
        (60.0, 1000.0, "turning"),
        (158.0, 200.0, "climb"),
        (100.0, 100.5, "room"),
    ],
)
def test_it_is_refused_in_a_turn_at_the_ends_and_without_room(start_s: float, end_s: float, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        spliced(OWN, route(120.0, 0.0, 26.0), start_s, end_s, RADIUS_M, WIND)
