"""Ways to give way: along the path or above it, within what the airframe can do."""

from hypothesis import given
from hypothesis import strategies as st

from missions.airframe import GRAVITY_M_S2, drag_n, thrust_max_n
from missions.reference import ReferenceTables
from missions.scenario import Scenario
from sitl.avoidance.course import Situation
from sitl.avoidance.manoeuvre import (
    AS_PLANNED,
    CLIMB,
    CLIMB_SLOWER,
    FASTER,
    HEIGHTS,
    HOLD,
    SLOWER,
    Manoeuvre,
    aside,
    going_on,
    means,
)
from sitl.guidance.path_errors import START, PathErrors, ScheduleClock

SAFE_M = 75.0


def situation(airspeed: float, slope: float) -> Situation:
    errors = PathErrors(0.0, 0.0, 0.0, 0.0, airspeed, 0.0, airspeed * slope, 0.0, 0.0, slope, 0.0)
    tables = ReferenceTables([], [], [], [], 0.0, 0.0)
    return Situation(
        (0.0, 0.0, 0.0), errors, START, airspeed, airspeed, ScheduleClock(0.0, 1.0, 0.0), 0.0, True, tables
    )


@given(st.sampled_from([SLOWER, FASTER, CLIMB, CLIMB_SLOWER]), st.floats(18.0, 36.0), st.floats(-0.1, 0.14))
def test_speeds_stay_within_the_airspeed_and_climbs_within_the_power(
    vee: Scenario, action: int, airspeed: float, slope: float
) -> None:
    airframe = vee.airframe.airframe()
    speed, climb = means(action, situation(airspeed, slope), airframe)
    if speed != 0.0:
        assert airframe.airspeed_min_m_s < airspeed + speed < airframe.airspeed_max_m_s
    assert climb >= 0.0
    if climb > 0.0 or speed > 0.0:
        flown, weight = airspeed + speed, airframe.mass_kg * GRAVITY_M_S2
        left_w = (thrust_max_n(flown, airframe) - drag_n(flown, weight, airframe)) * flown
        assert weight * (climb + airspeed * slope) <= left_w


@given(st.lists(st.tuples(st.sampled_from([-2.0, 0.0, 3.0]), st.integers(1, 3000)), max_size=6))
def test_nobody_is_ever_below_its_path_or_far_above_it(climbs: list[tuple[float, int]]) -> None:
    now = AS_PLANNED
    for climb, ticks in climbs:
        now = now._replace(climb_m_s=climb)
        for _ in range(ticks):
            now = going_on(now, SAFE_M)
            assert 0.0 <= now.raised_m <= HEIGHTS * SAFE_M


def test_only_height_is_flown_aside() -> None:
    errors = PathErrors(*map(float, range(1, 12)))
    moved = aside(errors, Manoeuvre(HOLD, 0.0, 2.0, 30.0, 0.0, 0.0, 0))
    assert moved == errors._replace(above=errors.above - 30.0, v_z=errors.v_z - 2.0)


def test_as_planned_nothing_changes() -> None:
    errors = PathErrors(*map(float, range(1, 12)))
    assert going_on(AS_PLANNED, SAFE_M) == AS_PLANNED
    assert aside(errors, AS_PLANNED) == errors
