"""Whoever would arrive too soon takes a longer way, and all arrive together."""

from collections.abc import Callable

import numpy as np
import pytest

from missions.scenario import Scenario
from planner.find_path import NO_WISH, Wish
from planner.lengthen import SPARE, too_short
from planner.plan import plan
from planner.schedule import arrival_window_s, even_schedule
from planner.verify import verify

SmallScenario = Callable[..., Scenario]

FAR = ((0.0, 10000.0, 0.0), (33000.0, 10000.0, 1000.0))
NEAR = ((0.0, 12000.0, 0.0), (12000.0, 13000.0, 500.0))
BESIDE = ((0.0, 14000.0, 0.0), (30000.0, 14000.0, 1000.0))


def straight(line: tuple[tuple[float, ...], tuple[float, ...]]) -> np.ndarray:
    return np.linspace(np.array(line[0]), np.array(line[1]), 8)


@pytest.fixture(scope="module")
def uneven(small_scenario: SmallScenario) -> Scenario:
    return small_scenario([FAR, NEAR, BESIDE], waypoints=8, radars=(), obstacles=())


def test_only_who_would_come_too_soon_is_asked_for_more(uneven: Scenario) -> None:
    paths = [straight(line) for line in (FAR, NEAR, BESIDE)]
    wishes = [NO_WISH, Wish(attempt=2), NO_WISH]
    again = too_short(paths, wishes, uneven)
    assert list(again) == [1]
    far, near = (arrival_window_s(path, uneven) for path in paths[:2])
    assert far is not None
    assert near is not None
    assert again[1].attempt == 2
    assert again[1].length_min_m == pytest.approx(SPARE * np.hypot(12000.0, 1000.0) * far[0] / near[1])


def test_who_already_has_the_way_that_was_asked_for_is_left_to_the_schedule(uneven: Scenario) -> None:
    paths = [straight(line) for line in (FAR, NEAR, BESIDE)]
    assert too_short(paths, [NO_WISH, Wish(length_min_m=1e6), NO_WISH], uneven) == {}


def test_nobody_is_asked_when_one_cannot_fly_its_path_at_all(uneven: Scenario) -> None:
    steep = straight(((0.0, 10000.0, 0.0), (33000.0, 10000.0, 16000.0)))
    assert arrival_window_s(steep, uneven) is None
    assert too_short([steep, straight(NEAR), straight(BESIDE)], [NO_WISH] * 3, uneven) == {}


def test_both_edges_of_a_window_can_be_flown_and_nothing_beyond(uneven: Scenario) -> None:
    path = straight(FAR)
    window = arrival_window_s(path, uneven)
    assert window is not None
    airspeeds = [float(even_schedule(path, seconds, (0.0, 0.0)).air_m_s.max()) for seconds in window]
    slowest, fastest = airspeeds[1], airspeeds[0]
    assert slowest == pytest.approx(uneven.airframe.airspeed_min_m_s + 2.0, abs=0.15)
    assert slowest < fastest <= uneven.airframe.airspeed_max_m_s - 2.0 + 1e-9


def test_a_near_target_is_reached_by_a_longer_way_together_with_the_others(uneven: Scenario) -> None:
    result = plan(uneven)
    assert verify(result, uneven).violations == ()
    far, near, _ = result.uavs
    assert near.length_m > 1.3 * near.straight_line_m
    assert far.length_m < 1.02 * far.straight_line_m
    arrivals = [reference.duration_s for reference in result.references(uneven).values()]
    assert np.ptp(arrivals) < 0.01
