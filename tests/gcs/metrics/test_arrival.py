import math
from collections.abc import Callable

import numpy as np
import pytest

from gcs.metrics.arrival import arrival
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.ticks import TICK_S


@pytest.fixture(scope="module")
def reference(radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan]) -> Reference:
    return straight_plan(radars).references(radars)[1]


def flight(reference: Reference, speed_m_s: float, beside_m: float = 0.0, ticks: int = 40000) -> np.ndarray:
    """Straight along the path at a speed, to its left by an offset; far beyond the target."""
    points = reference.points(np.arange(ticks) * TICK_S * speed_m_s)
    heading = reference.target_heading
    points[:, :2] += beside_m * np.array([-math.sin(heading), math.cos(heading)])
    return np.column_stack([points, np.zeros((ticks, 3))])


def test_crosses_the_target_plane_between_ticks(reference: Reference) -> None:
    speed_m_s = 27.3
    end = arrival(flight(reference, speed_m_s), reference)
    assert end.time_s == pytest.approx(reference.length_m / speed_m_s, abs=1e-6)
    assert end.tick == math.ceil(reference.length_m / speed_m_s / TICK_S)


def test_length_is_flown_in_space_up_to_the_plane(reference: Reference) -> None:
    start, target = reference.points(np.array([0.0, reference.length_m]))
    end = arrival(flight(reference, 27.3), reference)
    # The altitude's smoothing goes on with the end slopes, so a single leg is a straight line in space.
    assert end.length_m == pytest.approx(float(np.linalg.norm(target - start)), abs=1e-3)


@pytest.mark.parametrize(("beside_m", "arrives"), [(99.0, True), (-99.0, True), (101.0, False), (-101.0, False)])
def test_a_crossing_far_from_the_target_is_no_arrival(reference: Reference, beside_m: float, arrives: bool) -> None:
    end = arrival(flight(reference, 30.0, beside_m), reference)
    assert (end.time_s is not None) == arrives
    assert (end.tick is not None) == arrives


def test_a_vehicle_that_stops_short_has_flown_what_it_flew(reference: Reference) -> None:
    end = arrival(flight(reference, 30.0, ticks=1001), reference)
    slope = reference.leg_slope[0]
    assert end.time_s is None
    assert end.length_m == pytest.approx(30.0 * 40.0 * math.hypot(1.0, slope), rel=1e-9)


def test_the_loiter_after_the_arrival_changes_nothing(reference: Reference) -> None:
    truth = flight(reference, 30.0)
    end = arrival(truth, reference)
    assert end.tick is not None
    angle = np.linspace(0.0, 20.0, 5000)[:, None]
    circle = truth[end.tick, :3] + 60.0 * np.hstack([np.sin(angle), 1.0 - np.cos(angle), np.zeros_like(angle)])
    looped = np.vstack([truth[: end.tick + 1], np.hstack([circle, np.zeros((5000, 3))])])
    assert arrival(looped, reference) == end


def test_one_row_is_no_flight(reference: Reference) -> None:
    end = arrival(np.zeros((1, 6)), reference)
    assert (end.time_s, end.length_m) == (None, 0.0)
