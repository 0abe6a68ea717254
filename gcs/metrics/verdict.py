"""What fell short in a flight, for people and for the exit code."""

import math
from collections.abc import Iterator

from gcs.metrics.flight_limits import FlightLimits
from gcs.metrics.metrics import FormationMetrics, Metrics, VehicleMetrics
from gcs.metrics.scheduled import kills_s
from missions.airframe import GRAVITY_M_S2
from missions.scenario import Scenario
from sitl.aircraft.gusts import INTENSITIES_M_S
from sitl.ticks import TICK_S

TRACKING_M = 10.0
"""A plan keeps its distance from ground and obstacles; the aircraft keeps to the plan, in gusts, within this."""
GUST_SIGMAS = 3.0
"""No command holds off a gust: airspeed is short of its limits only beyond so many standard deviations of it."""
CLIMB_RATE_M_S = 0.5
"""What lags let the climb rate overshoot."""


def shortfalls(metrics: Metrics, scenario: Scenario) -> list[str]:
    """One line for each thing that fell short; none when all is well."""
    names = {vehicle.sysid: vehicle.name for vehicle in metrics.vehicles}
    kills = kills_s(scenario)
    lines = [line for vehicle in metrics.vehicles for line in _vehicle(vehicle, kills.get(vehicle.sysid))]
    lines += _distances(metrics.formation, scenario)
    for limits in metrics.limits:
        lines += [f"{names[limits.sysid]}: {line}" for line in _limits(limits, scenario)]
    return lines


def _vehicle(vehicle: VehicleMetrics, killed_s: float | None) -> Iterator[str]:
    if vehicle.lost_s is not None and killed_s is not None and abs(vehicle.lost_s - killed_s) < TICK_S:
        pass  # as the scenario has it
    elif vehicle.lost_s is not None:
        yield f"{vehicle.name}: lost after {vehicle.lost_s:.1f} s"
    elif not vehicle.completed:
        yield f"{vehicle.name}: did not arrive at its target"
    if vehicle.items_verified != vehicle.items_uploaded:
        yield f"{vehicle.name}: {vehicle.items_verified} of {vehicle.items_uploaded} mission items verified"


def _distances(formation: FormationMetrics, scenario: Scenario) -> Iterator[str]:
    limits = scenario.limits
    separation, margin, wall = formation.min_separation_m, formation.clearance_margin_m, formation.min_wall_m
    if separation is not None and separation < limits.separation_m:
        yield f"separation: {separation:.0f} m at the least, limits.separation_m is {limits.separation_m:g}"
    if margin is not None and margin < -TRACKING_M:
        yield f"clearance: {-margin:.0f} m less than limits.clearance_m asks for"
    if wall is not None and wall < limits.obstacle_margin_m - TRACKING_M:
        yield f"obstacles: {wall:.0f} m at the least, limits.obstacle_margin_m is {limits.obstacle_margin_m:g}"


def _limits(limits: FlightLimits, scenario: Scenario) -> Iterator[str]:
    airframe = scenario.airframe
    gusts_m_s = GUST_SIGMAS * INTENSITIES_M_S[scenario.wind.gusts][0]
    if limits.airspeed_min_m_s < airframe.airspeed_min_m_s - gusts_m_s:
        yield f"airspeed {limits.airspeed_min_m_s:.1f} m/s, airspeed_min_m_s is {airframe.airspeed_min_m_s:g}"
    if limits.airspeed_max_m_s > airframe.airspeed_max_m_s + gusts_m_s:
        yield f"airspeed {limits.airspeed_max_m_s:.1f} m/s, airspeed_max_m_s is {airframe.airspeed_max_m_s:g}"
    sink, climb, turn = limits.climb_rate_min_m_s, limits.climb_rate_max_m_s, limits.turn_rate_max_deg_s
    if sink is not None and sink < airframe.climb_rate_min_m_s - CLIMB_RATE_M_S:
        yield f"climb rate {sink:.1f} m/s, climb_rate_min_m_s is {airframe.climb_rate_min_m_s:g}"
    if climb is not None and climb > airframe.climb_rate_max_m_s + CLIMB_RATE_M_S:
        yield f"climb rate {climb:.1f} m/s, climb_rate_max_m_s is {airframe.climb_rate_max_m_s:g}"
    turn_max = math.degrees(airframe.load_factor_max * GRAVITY_M_S2 / limits.airspeed_max_m_s)
    if turn is not None and turn > turn_max:
        yield f"turn rate {turn:.0f} deg/s, load_factor_max allows {turn_max:.0f}"
