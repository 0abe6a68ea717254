"""Speeds of legs: limits kept, arrivals equal, errors that name who and where."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.errors import InputError
from missions.reference import airspeed_on_track, ground_speed_on_track
from missions.scenario import Scenario, load_scenario
from planner.limits import POWER_SHARE, airspeed_range_m_s, power_share
from planner.schedule import common_arrival, even_schedule, flyable_at, leg_faults, timed_schedule

RADARS = load_scenario("radars")


def windy(wind_m_s: tuple[float, float]) -> Scenario:
    wind = RADARS.wind.model_copy(update={"forecast_m_s": wind_m_s})
    return RADARS.model_copy(update={"wind": wind})


def bent(length_m: float, rng: np.random.Generator) -> np.ndarray:
    """A path of five legs, with gentle turns and climbs."""
    x = np.linspace(0.0, length_m, 6)
    return np.column_stack([x, rng.uniform(-500, 500, 6), np.linspace(0, length_m * rng.uniform(0, 0.05), 6)])


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    lengths=st.lists(st.floats(20e3, 24e3), min_size=1, max_size=4),
    wind=st.tuples(st.floats(-3, 3), st.floats(-3, 3)),
)
def test_all_arrive_together_within_the_limits(seed: int, lengths: list[float], wind: tuple[float, float]) -> None:
    rng = np.random.default_rng(seed)
    scenario = windy(wind)
    paths = [bent(length, rng) for length in lengths]
    schedules = common_arrival([f"F{i}" for i in range(len(paths))], paths, scenario)
    durations = [schedule.duration_s for schedule in schedules]
    assert durations == pytest.approx([durations[0]] * len(durations), abs=1e-3)
    slowest, fastest = airspeed_range_m_s(scenario)
    for path, schedule in zip(paths, schedules, strict=True):
        assert np.all((schedule.air_m_s >= slowest) & (schedule.air_m_s <= fastest))
        assert np.ptp(schedule.ground_m_s) == pytest.approx(0.0, abs=1e-9)
        legs = np.diff(path, axis=0)
        for k, airspeed in enumerate(schedule.air_m_s):
            heading = float(np.arctan2(legs[k, 1], legs[k, 0]))
            ground = ground_speed_on_track(float(airspeed), float(schedule.slopes[k]), heading, wind)
            assert ground == pytest.approx(schedule.ground_m_s[k], rel=1e-9)
            climb = ground * float(schedule.slopes[k]) / float(airspeed)
            assert power_share(float(airspeed), climb, scenario.airframe.airframe()) <= POWER_SHARE + 1e-6


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32), wind=st.tuples(st.floats(-3, 3), st.floats(-3, 3)), climb=st.floats(-0.1, 0.12))
def test_what_can_be_flown_at_a_speed_is_what_has_no_fault(seed: int, wind: tuple[float, float], climb: float) -> None:
    path = bent(20e3, np.random.default_rng(seed))
    path[:, 2] = path[:, 0] * climb
    scenario = windy(wind)
    draft = even_schedule(path, 20e3 / 28.0, wind)
    legs = np.diff(path, axis=0)
    speedups = np.linspace(0.6, 1.35, 40)
    possible = flyable_at(
        speedups,
        draft.ground_m_s,
        draft.slopes,
        np.arctan2(legs[:, 1], legs[:, 0]),
        wind,
        airspeed_range_m_s(scenario),
        scenario.airframe.airframe(),
    )
    for speedup, found in zip(speedups, possible, strict=True):
        ground = draft.ground_m_s * speedup
        headings = np.arctan2(legs[:, 1], legs[:, 0])
        air = [airspeed_on_track(*of, wind) for of in zip(ground, draft.slopes, headings, strict=True)]
        schedule = replace(draft, ground_m_s=ground, air_m_s=np.array(air))
        assert found == (not list(leg_faults(schedule, scenario)))


def test_the_longest_path_is_flown_near_cruise_when_all_can() -> None:
    rng = np.random.default_rng(0)
    schedules = common_arrival(["a", "b"], [bent(20e3, rng), bent(22e3, rng)], RADARS)
    assert schedules[1].ground_m_s[0] == pytest.approx(RADARS.airframe.airspeed_cruise_m_s, abs=0.3)
    assert schedules[0].ground_m_s[0] < schedules[1].ground_m_s[0]


def test_times_at_the_corners_are_kept() -> None:
    path = bent(20e3, np.random.default_rng(2))
    times = np.array([0.0, 150.0, 290.0, 440.0, 580.0, 730.0])
    schedule = timed_schedule(path, times, (1.0, -2.0))
    assert np.cumsum(schedule.arcs_m / schedule.ground_m_s) == pytest.approx(times[1:], abs=1e-6)


def test_paths_too_unlike_name_the_vehicle_and_the_leg() -> None:
    rng = np.random.default_rng(0)
    with pytest.raises(InputError, match=r"radars: \w+: leg \d: airspeed .* to arrive with the others after \d+ s"):
        common_arrival(["short", "long"], [bent(10e3, rng), bent(30e3, rng)], RADARS)


def test_a_climb_beyond_the_power_names_the_vehicle_and_the_leg() -> None:
    steep = np.array([[0.0, 0, 0], [5000, 0, 0], [10000, 0, 1500], [15000, 0, 1500]])
    with pytest.raises(InputError, match=r"radars: F7: leg 2: \d+% of the power"):
        common_arrival(["F7"], [steep], RADARS)


@pytest.mark.parametrize(
    ("duration", "fault"), [(600.0, "leg 1: airspeed 16.7"), (250.0, "leg 1: airspeed 40.0"), (300.0, "leg 2: 1")]
)
def test_each_fault_is_told(duration: float, fault: str) -> None:
    path = np.array([[0.0, 0, 0], [5000, 0, 0], [10000, 0, 400]])
    found = list(leg_faults(even_schedule(path, duration, (0.0, 0.0)), RADARS))
    assert any(text.startswith(fault) for text in found), found
