"""The flight of one aircraft over one tick: wind, wanted accelerations, motion (MODEL, sections 5 and 6).

Pure functions of plain values in the dialect that plain Python and numba compute bit for bit alike.
"""

import math
from typing import NamedTuple

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n
from missions.environment.terrain import Terrain, ground_height_m
from missions.reference.path import path_at
from missions.reference.reference import ReferenceTables
from missions.reference.smoothing import quadratic_at
from sitl.aircraft.actuators import LagGains, lag_gains, lagged
from sitl.aircraft.gusts import GustFilter, GustState, Normals, gust_filter, start_gusts, step_gusts, wind_at
from sitl.aircraft.linearisation import controls_for
from sitl.aircraft.point_mass import AirState, Controls, air_velocity, rk4_step, with_air_velocity
from sitl.guidance.path_errors import START, PathErrors, PathPoint
from sitl.guidance.path_law import (
    PLANNED_ROOM_M_S,
    Accelerations,
    across_acceleration,
    limited,
    speed_before_height,
    up_acceleration,
)
from sitl.ticks import TICK_S

Vector = tuple[float, float, float]

LAUNCH_SLOPE = 0.08
"""Of a launch that no path prescribes."""
STEEPEST_LAUNCH = 0.25
"""However steep the path begins; the launch is at cruise then."""


class Aircraft(NamedTuple):
    """What does not change in flight."""

    airframe: Airframe
    terrain: Terrain
    gusts: GustFilter
    steady_wind: tuple[float, float]
    lags: LagGains


class Flight(NamedTuple):
    """What does: state, actuators, gusts, the wind they make (east, north, up), and the place on the path."""

    air: AirState
    controls: Controls
    gusts: GustState
    wind: Vector
    point: PathPoint


def make_aircraft(airframe: Airframe, terrain: Terrain, gusts: str, steady_wind: tuple[float, float]) -> Aircraft:
    """The constants of one aircraft."""
    return Aircraft(airframe, terrain, gust_filter(gusts, TICK_S), steady_wind, lag_gains(airframe, TICK_S))


def parked(position: Vector, heading: float) -> Flight:
    """On the launcher: at rest, actuators idle."""
    state = AirState(position[0], position[1], position[2], 0.0, 0.0, heading)
    return Flight(state, Controls(0.0, 0.0, 0.0), GustState(0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), START)


def launched(position: Vector, tables: ReferenceTables, normals: Normals, aircraft: Aircraft) -> Flight:
    """Off the catapult: at the scheduled speed along the first leg, trimmed, in the air's first gust."""
    _, _, heading, _, _ = path_at(0.0, 0, tables.segments)
    _, slope, _, _ = quadratic_at(0.0, 0, tables.altitude)
    _, speed, _, _ = quadratic_at(0.0, 0, tables.schedule)
    if abs(slope) > STEEPEST_LAUNCH:
        slope = math.copysign(STEEPEST_LAUNCH, slope)
        speed = aircraft.airframe.airspeed_cruise_m_s
    return launched_along(position, heading, slope, speed, normals, aircraft)


def launched_along(
    position: Vector, heading: float, slope: float, speed: float, normals: Normals, aircraft: Aircraft
) -> Flight:
    """Off the catapult along a heading and a slope, at a speed over ground."""
    gusts = start_gusts(normals, aircraft.gusts)
    wind = wind_at(gusts, aircraft.gusts, heading, aircraft.steady_wind)
    velocity = (
        speed * math.cos(heading) - wind[0],
        speed * math.sin(heading) - wind[1],
        speed * slope - wind[2],
    )
    state = with_air_velocity(AirState(position[0], position[1], position[2], speed, 0.0, heading), velocity)
    weight = aircraft.airframe.mass_kg * GRAVITY_M_S2
    lift = weight * math.cos(state.gamma)
    thrust = drag_n(state.V, lift, aircraft.airframe) + weight * math.sin(state.gamma)
    return Flight(state, Controls(max(thrust, 0.0), lift, 0.0), gusts, wind, START)


def in_next_wind(flight: Flight, normals: Normals, aircraft: Aircraft) -> Flight:
    """The gusts of the next tick. A change of wind acts on the airspeed: the ground velocity is continuous."""
    gusts = step_gusts(flight.gusts, normals, aircraft.gusts)
    wind = wind_at(gusts, aircraft.gusts, flight.air.chi, aircraft.steady_wind)
    east, north, up = air_velocity(flight.air)
    velocity = (
        east - (wind[0] - flight.wind[0]),
        north - (wind[1] - flight.wind[1]),
        up - (wind[2] - flight.wind[2]),
    )
    return Flight(with_air_velocity(flight.air, velocity), flight.controls, gusts, wind, flight.point)


def ground_velocity(flight: Flight) -> Vector:
    """Velocity over ground, (east, north, up)."""
    east, north, up = air_velocity(flight.air)
    return east + flight.wind[0], north + flight.wind[1], up + flight.wind[2]


def at_point(flight: Flight, point: PathPoint) -> Flight:
    """The flight with another place on the path."""
    return Flight(flight.air, flight.controls, flight.gusts, flight.wind, point)


def path_accelerations(errors: PathErrors, ahead: float, airspeed: float, airframe: Airframe) -> Accelerations:
    """Keep to the path of a mission with a given acceleration along it."""
    wanted = Accelerations(
        ahead,
        across_acceleration(errors),
        up_acceleration(errors.above, errors.v_z, errors.v_t * errors.slope),
        errors.heading,
    )
    return speed_before_height(wanted, airspeed, PLANNED_ROOM_M_S, airframe)


def airspeed_at(s_m: float, airspeeds: list[tuple[float, float]]) -> float:
    """The leg's commanded airspeed at an arc length; rows (from, airspeed)."""
    wanted = airspeeds[0][1]
    for i in range(len(airspeeds)):
        if s_m >= airspeeds[i][0]:
            wanted = airspeeds[i][1]
    return wanted


def moved(flight: Flight, wanted: Accelerations, aircraft: Aircraft) -> Flight:
    """One tick of flight: limits, feedback linearisation, actuators, one Runge-Kutta step; never below the ground."""
    airframe = aircraft.airframe
    v_z = flight.air.V * math.sin(flight.air.gamma) + flight.wind[2]
    a = limited(wanted, flight.air.V, v_z, airframe)
    cos_heading = math.cos(a.heading)
    sin_heading = math.sin(a.heading)
    command = controls_for(
        a.ahead * cos_heading - a.left * sin_heading,
        a.ahead * sin_heading + a.left * cos_heading,
        a.up,
        flight.air,
        airframe,
    )
    controls = lagged(flight.controls, command, aircraft.lags)
    state = rk4_step(flight.air, controls, flight.wind, airframe, TICK_S)
    ground = ground_height_m(state.x, state.y, aircraft.terrain)
    if state.h < ground:
        state = AirState(state.x, state.y, ground, state.V, state.gamma, state.chi)
    return Flight(state, controls, flight.gusts, flight.wind, flight.point)
