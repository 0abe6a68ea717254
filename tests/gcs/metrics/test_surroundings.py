import math

import numpy as np
import pytest

from gcs.metrics.surroundings import surroundings
from missions.scenario import Scenario, load_scenario
from sitl.ticks import TICK_S

SPEED_M_S = 25.0


def eastward(start: tuple[float, float, float], length_m: float, climb: float = 0.0) -> np.ndarray:
    """Positions along a straight line to the east at `SPEED_M_S` over ground."""
    along = np.arange(round(length_m / SPEED_M_S / TICK_S) + 1) * TICK_S * SPEED_M_S
    return np.array(start) + np.column_stack([along, np.zeros_like(along), climb * along])


def test_exposure_is_the_chord_through_a_radar_over_the_speed(radars: Scenario) -> None:
    radar = radars.radars[0]
    off_m = (600.0, 800.0)
    start = (radar.x_m - 4000.0, radar.y_m - off_m[0], radar.z_m + off_m[1])
    chord_m = 2.0 * math.sqrt(radar.radius_m**2 - 1000.0**2)
    exposure_s = surroundings(eastward(start, 8000.0), radars).radar_exposure_s
    assert exposure_s == pytest.approx(chord_m / SPEED_M_S, abs=2 * TICK_S)


def test_passing_outside_a_radar_is_no_exposure(radars: Scenario) -> None:
    radar = radars.radars[0]
    start = (radar.x_m - 4000.0, radar.y_m, radar.z_m + radar.radius_m + 1.0)
    assert surroundings(eastward(start, 8000.0), radars).radar_exposure_s == 0.0


def test_clearance_counts_once_30_m_have_been_passed(radars: Scenario) -> None:
    flight = eastward((0.0, 31000.0, 0.0), 4000.0, climb=0.1)
    flight[2000:, 2] = 45.0
    assert surroundings(flight, radars).clearance_m == pytest.approx(30.0, abs=0.1 * SPEED_M_S * TICK_S)
    flight[-1, 2] = 12.0
    assert surroundings(flight, radars).clearance_m == pytest.approx(12.0)


def test_clearance_margin_grows_over_the_climb_out(radars: Scenario) -> None:
    limits = radars.limits
    flight = eastward((0.0, 31000.0, 0.0), 6000.0, climb=0.06)
    # 500 m out, at 30 m, the limit asks for a quarter of itself; from there on the flight gains on it.
    margin = surroundings(flight, radars).clearance_margin_m
    assert margin == pytest.approx(30.0 - limits.clearance_m * 500.0 / limits.climb_out_m, abs=0.1)
    level = flight.copy()
    level[:, 2] = np.minimum(level[:, 2], 88.0)
    assert surroundings(level, radars).clearance_margin_m == pytest.approx(88.0 - limits.clearance_m)


def test_clearance_is_above_the_mountain_below() -> None:
    mountains = load_scenario("mountains")
    peak = mountains.terrain.peaks[2]
    flight = eastward((peak.x_m - 9000.0, peak.y_m, peak.height_m + 250.0), 18000.0)
    assert surroundings(flight, mountains).clearance_m == pytest.approx(250.0, abs=0.1)


def test_walls_are_as_near_as_the_flight_passed(radars: Scenario) -> None:
    obstacle = radars.obstacles[1]
    start = (obstacle.x_m - 3000.0, obstacle.y_m - obstacle.radius_m - 130.0, 700.0)
    assert surroundings(eastward(start, 6000.0), radars).wall_m == pytest.approx(130.0, abs=0.01)


def test_nothing_is_known_of_a_vehicle_that_was_never_airborne_or_never_seen(radars: Scenario) -> None:
    for positions in (eastward((0.0, 31000.0, 5.0), 500.0), np.full((100, 3), np.nan)):
        around = surroundings(positions, radars)
        assert (around.clearance_m, around.clearance_margin_m, around.wall_m) == (None, None, None)
        assert around.radar_exposure_s == 0.0
