"""The swarm's clock: who cannot keep its schedule takes all others with it, and nobody goes farther than that."""

import itertools
from collections import deque

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.airframe import Airframe, thrust_max_n
from missions.scenario import Scenario
from sitl.aircraft.point_mass import AirState, Controls
from sitl.formation.graph import edges
from sitl.formation.swarm_clock import (
    FROM_M,
    HANDED_ON,
    MOST,
    PER_M,
    SMOOTH_S,
    UNSHIFTED,
    Shift,
    Shifts,
    grown,
    longest_s,
    neighbours_need,
    own_needs,
    schedule_clock,
)
from sitl.ticks import TICK_S

COUNT = 6


@pytest.fixture(scope="module")
def airframe(vee: Scenario) -> Airframe:
    return vee.airframe.airframe()


def run(kind: str, delay_ticks: int, needs: dict[int, tuple[float, float]], seconds: float) -> list[list[Shift]]:
    """One sum of each of nine vehicles, tick by tick; `needs` are rates that vehicles ask for, each until a time."""
    neighbours: dict[int, list[int]] = {p: [] for p in range(COUNT)}
    for p, q in edges(kind, range(COUNT)):
        neighbours[p].append(q)
        neighbours[q].append(p)
    now = [UNSHIFTED.slowed] * COUNT
    past = deque([now] * delay_ticks, maxlen=delay_ticks)
    history = [now]
    for tick in range(round(seconds / TICK_S)):
        said = past[0]
        past.append(now)
        wanted = []
        for p in range(COUNT):
            rate, until_s = needs.get(p, (0.0, 0.0))
            need = rate if tick * TICK_S < until_s else 0.0
            for q in neighbours[p]:
                need = max(need, neighbours_need(now[p].sum_s, said[q].sum_s, said[q].rate))
            wanted.append(need)
        now = [grown(shift, need) for shift, need in zip(now, wanted, strict=True)]
        history.append(now)
    return history


@settings(max_examples=10)
@given(
    kind=st.sampled_from(["ring", "line", "star", "complete"]),
    delay_ticks=st.integers(1, 25),
    needs=st.dictionaries(
        st.integers(0, COUNT - 1), st.tuples(st.floats(0.0, 0.5), st.floats(0.0, 20.0)), min_size=1, max_size=3
    ),
)
def test_all_go_where_the_greatest_is_then_rest_and_never_go_back(
    kind: str, delay_ticks: int, needs: dict[int, tuple[float, float]]
) -> None:
    history = run(kind, delay_ticks, needs, 300.0)
    for before, after in itertools.pairwise(history):
        for one, later in zip(before, after, strict=True):
            assert one.sum_s <= later.sum_s
            assert 0.0 <= later.rate <= MOST
    sums = [shift.sum_s for shift in history[-1]]
    assert max(sums) - min(sums) < 0.01
    assert max(shift.rate for shift in history[-1]) < 1e-3
    most = max(min(rate, MOST) * until_s for rate, until_s in needs.values())
    handed_round_s = HANDED_ON / (1.0 - HANDED_ON) * (delay_ticks * TICK_S + SMOOTH_S)
    assert 0.9 * most - 0.5 <= max(sums) <= most + MOST * handed_round_s + 0.1


@pytest.mark.parametrize("kind", ["ring", "line"])
def test_while_one_slows_down_steadily_the_others_are_close_behind(kind: str) -> None:
    steady = run(kind, 5, {0: (0.1, 1e9)}, 120.0)[-1]
    assert all(shift.rate == pytest.approx(0.1, abs=0.001) for shift in steady)
    hops = COUNT - 1 if kind == "line" else COUNT // 2
    assert max(shift.sum_s for shift in steady) - min(shift.sum_s for shift in steady) < 0.045 * hops


def state(airspeed_m_s: float) -> AirState:
    return AirState(0.0, 0.0, 100.0, airspeed_m_s, 0.0, 0.0)


@given(st.floats(-1e4, 1e4), st.floats(20.0, 35.0), st.floats(0.1, 0.9))
def test_who_can_still_go_faster_and_slower_asks_for_nothing(
    airframe: Airframe, along_m: float, airspeed_m_s: float, share: float
) -> None:
    controls = Controls(share * thrust_max_n(airspeed_m_s, airframe), 100.0, 0.0)
    assert own_needs(along_m, state(airspeed_m_s), controls, airframe) == (0.0, 0.0)


def test_who_is_late_at_full_power_slows_all_and_who_is_early_at_its_least_speed_hurries_all(
    airframe: Airframe,
) -> None:
    power, idle = Controls(thrust_max_n(28.0, airframe), 100.0, 0.0), Controls(0.0, 100.0, 0.0)
    half = Controls(0.5 * thrust_max_n(28.0, airframe), 100.0, 0.0)
    need = PER_M * 2.0
    assert own_needs(-FROM_M - 2.0, state(28.0), power, airframe) == pytest.approx((need, 0.0))
    assert own_needs(-FROM_M - 2.0, state(36.0), half, airframe) == pytest.approx((need, 0.0))
    assert own_needs(FROM_M + 2.0, state(28.0), idle, airframe) == pytest.approx((0.0, need))
    assert own_needs(FROM_M + 2.0, state(18.5), half, airframe) == pytest.approx((0.0, need))
    assert own_needs(FROM_M + 2.0, state(28.0), power, airframe) == (0.0, 0.0)
    assert own_needs(-FROM_M - 2.0, state(28.0), idle, airframe) == (0.0, 0.0)


@given(st.floats(0.0, MOST), st.floats(0.0, MOST))
def test_the_clocks_rate_is_what_its_time_does(slow: float, hurry: float) -> None:
    before = Shifts(Shift(3.0, 0.1, 0.0), Shift(5.0, 0.2, 0.0))
    after = Shifts(grown(before.slowed, slow), grown(before.hurried, hurry))
    first, then = schedule_clock(100.0, before), schedule_clock(100.0 + TICK_S, after)
    assert then.time_s - first.time_s == pytest.approx(then.rate * TICK_S)
    assert then.rate - first.rate == pytest.approx(then.change * TICK_S)


def test_a_schedule_that_is_slowed_all_the_way_takes_no_longer_than_said() -> None:
    shift, ticks = UNSHIFTED.slowed, 0
    while schedule_clock(ticks * TICK_S, Shifts(shift, UNSHIFTED.hurried)).time_s < 70.0:
        shift, ticks = grown(shift, 1.0), ticks + 1
    assert 99.0 <= ticks * TICK_S <= longest_s(70.0)
