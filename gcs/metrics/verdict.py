"""What a flight is held to, and what fell short, for people and for the exit code."""

import math
from collections.abc import Iterator
from typing import NamedTuple

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


class Check(NamedTuple):
    """One thing that a flight is held to.

    Attributes:
        what: the same for all vehicles.
        measured, limit: for people, with units; the limit with what it tolerates.
        room: how far on the good side of that it was, in the unit of both; negative when it fell short.
        shortfall: the line that says so.
    """

    what: str
    measured: str
    limit: str
    room: float
    shortfall: str


def shortfalls(metrics: Metrics, scenario: Scenario) -> list[str]:
    """One line for each thing that fell short; none when all is well."""
    return [check.shortfall for check in checks(metrics, scenario) if check.room < 0.0]


def checks(metrics: Metrics, scenario: Scenario) -> list[Check]:
    """All that a flight is held to, a vehicle's one by one."""
    names = {vehicle.sysid: vehicle.name for vehicle in metrics.vehicles}
    kills = kills_s(scenario)
    found = [check for vehicle in metrics.vehicles for check in _vehicle(vehicle, kills.get(vehicle.sysid))]
    found += _distances(metrics.formation, scenario)
    for limits in metrics.limits:
        found += _limits(names[limits.sysid], limits, scenario)
    return found


def _vehicle(vehicle: VehicleMetrics, killed_s: float | None) -> Iterator[Check]:
    name, lost_s = vehicle.name, vehicle.lost_s
    as_scheduled = lost_s is not None and killed_s is not None and abs(lost_s - killed_s) < TICK_S
    if not as_scheduled:
        why = "did not arrive at its target" if lost_s is None else f"lost after {lost_s:.1f} s"
        arrived = vehicle.completed and lost_s is None
        measured = f"{name} {'arrived' if arrived else why}"
        yield Check("arrival", measured, "at its target", 0.0 if arrived else -1.0, f"{name}: {why}")
    uploaded, verified = vehicle.items_uploaded, vehicle.items_verified
    if uploaded is not None or verified is not None:
        line = f"{verified} of {uploaded} mission items verified"
        yield Check("mission", f"{name} {line}", "all", 0.0 if verified == uploaded else -1.0, f"{name}: {line}")


def _distances(formation: FormationMetrics, scenario: Scenario) -> Iterator[Check]:
    limits = scenario.limits
    separation, margin, wall = formation.min_separation_m, formation.clearance_margin_m, formation.min_wall_m
    if separation is not None:
        yield Check(
            "least separation",
            f"{separation:.0f} m",
            f"{limits.separation_m:g} m",
            separation - limits.separation_m,
            f"separation: {separation:.0f} m at the least, limits.separation_m is {limits.separation_m:g}",
        )
    if margin is not None:
        yield Check(
            "clearance above the ground",
            f"{abs(margin):.0f} m {'more' if margin >= 0.0 else 'less'} than asked for",
            f"{limits.clearance_m:g} m, within {TRACKING_M:g} m",
            margin + TRACKING_M,
            f"clearance: {-margin:.0f} m less than limits.clearance_m asks for",
        )
    if wall is not None:
        yield Check(
            "distance from obstacles",
            f"{wall:.0f} m",
            f"{limits.obstacle_margin_m:g} m, within {TRACKING_M:g} m",
            wall - (limits.obstacle_margin_m - TRACKING_M),
            f"obstacles: {wall:.0f} m at the least, limits.obstacle_margin_m is {limits.obstacle_margin_m:g}",
        )


def _limits(name: str, limits: FlightLimits, scenario: Scenario) -> Iterator[Check]:
    airframe = scenario.airframe
    gusts_m_s = GUST_SIGMAS * INTENSITIES_M_S[scenario.wind.gusts][0]
    slow, fast = limits.airspeed_min_m_s, limits.airspeed_max_m_s
    yield Check(
        "lowest airspeed",
        f"{name} {slow:.1f} m/s",
        f"{airframe.airspeed_min_m_s:g} m/s, less {gusts_m_s:.1f} in gusts",
        slow - (airframe.airspeed_min_m_s - gusts_m_s),
        f"{name}: airspeed {slow:.1f} m/s, airspeed_min_m_s is {airframe.airspeed_min_m_s:g}",
    )
    yield Check(
        "highest airspeed",
        f"{name} {fast:.1f} m/s",
        f"{airframe.airspeed_max_m_s:g} m/s, and {gusts_m_s:.1f} in gusts",
        airframe.airspeed_max_m_s + gusts_m_s - fast,
        f"{name}: airspeed {fast:.1f} m/s, airspeed_max_m_s is {airframe.airspeed_max_m_s:g}",
    )
    sink, climb, turn = limits.climb_rate_min_m_s, limits.climb_rate_max_m_s, limits.turn_rate_max_deg_s
    if sink is not None:
        yield Check(
            "steepest sink",
            f"{name} {sink:.1f} m/s",
            f"{airframe.climb_rate_min_m_s:g} m/s, within {CLIMB_RATE_M_S:g}",
            sink - (airframe.climb_rate_min_m_s - CLIMB_RATE_M_S),
            f"{name}: climb rate {sink:.1f} m/s, climb_rate_min_m_s is {airframe.climb_rate_min_m_s:g}",
        )
    if climb is not None:
        yield Check(
            "steepest climb",
            f"{name} {climb:.1f} m/s",
            f"{airframe.climb_rate_max_m_s:g} m/s, within {CLIMB_RATE_M_S:g}",
            airframe.climb_rate_max_m_s + CLIMB_RATE_M_S - climb,
            f"{name}: climb rate {climb:.1f} m/s, climb_rate_max_m_s is {airframe.climb_rate_max_m_s:g}",
        )
    if turn is not None:
        most = math.degrees(airframe.load_factor_max * GRAVITY_M_S2 / fast)
        yield Check(
            "fastest turn",
            f"{name} {turn:.0f} deg/s",
            f"{most:.0f} deg/s",
            most - turn,
            f"{name}: turn rate {turn:.0f} deg/s, load_factor_max allows {most:.0f}",
        )
