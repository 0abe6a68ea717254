"""Coming down to the ground: the approach that can be flown, flaps, flare, and the roll to a stop."""

import math

from missions.airframe import GRAVITY_M_S2, Airframe, drag_n
from missions.environment.terrain import Terrain, ground_height_m
from missions.errors import InputError
from sitl.aircraft.point_mass import AirState, Controls
from sitl.flight import Flight, Vector, ground_velocity
from sitl.guidance.path_law import VELOCITY_GAIN, Accelerations, speed_acceleration
from sitl.ticks import TICK_S

FLAPS_DRAG_COEFFICIENT = 0.06
"""Of flaps and spoilers, out from the last waypoint on. An assumption: it lets a clean aircraft come down at 7 deg."""
APPROACH_AIRSPEED_RATIO = 1.25
"""Over the least airspeed."""
SINK_SHARE = 0.75
"""Of the greatest sink rate that an approach may take, gusts and wind being what they are."""
FLARE_SINK_1_S = 0.35
TOUCHDOWN_SINK_M_S = 0.4
"""In the flare it sinks this fast, and FLARE_SINK_1_S faster for each metre of height."""
BRAKING_M_S2 = 2.5
APPROACH_STEP_M = 20.0
APPROACH_CLEARANCE_M = 10.0
"""Over the ground on the approach, or half of the height above the touchdown where that is less."""


def approach_airspeed_m_s(airframe: Airframe) -> float:
    """What is flown from the last waypoint to the flare."""
    return APPROACH_AIRSPEED_RATIO * airframe.airspeed_min_m_s


def with_flaps(airframe: Airframe) -> Airframe:
    """The airframe with flaps and spoilers out."""
    return airframe._replace(drag_coefficient_zero_lift=airframe.drag_coefficient_zero_lift + FLAPS_DRAG_COEFFICIENT)


def steepest_slope(airframe: Airframe, wind_m_s: float) -> float:
    """The steepest glide path (dz over distance, positive) that is flown at the approach airspeed.

    Args:
        wind_m_s: that may blow from behind.
    """
    airspeed, weight_n = approach_airspeed_m_s(airframe), airframe.mass_kg * GRAVITY_M_S2
    by_drag = drag_n(airspeed, weight_n, with_flaps(airframe)) / weight_n
    return min(by_drag, -SINK_SHARE * airframe.climb_rate_min_m_s / (airspeed + wind_m_s))


def check_approach(
    seq: int, start_m: Vector, touchdown_m: Vector, airframe: Airframe, terrain: Terrain, wind_m_s: float
) -> None:
    """Raise InputError, naming mission item `seq`, when that straight glide path cannot be flown or hits the ground."""
    distance_m = math.dist(start_m[:2], touchdown_m[:2])
    height_m = start_m[2] - touchdown_m[2]
    steepest = steepest_slope(airframe, wind_m_s)
    if height_m > steepest * distance_m:
        raise InputError(
            f"mission item {seq}: LAND: {height_m:.0f} m to lose over {distance_m:.0f} m from the item before; "
            f"put that at least {height_m / steepest:.0f} m away, or lower"
        )
    steps = max(math.ceil(distance_m / APPROACH_STEP_M), 1)
    for i in range(steps):
        share = i / steps
        x = start_m[0] + share * (touchdown_m[0] - start_m[0])
        y = start_m[1] + share * (touchdown_m[1] - start_m[1])
        above_m = (1.0 - share) * height_m
        ground = ground_height_m(x, y, terrain) - touchdown_m[2]
        if above_m - ground < min(APPROACH_CLEARANCE_M, 0.5 * above_m):
            raise InputError(
                f"mission item {seq}: LAND: the approach is {above_m - ground:.0f} m above the ground "
                f"{(1.0 - share) * distance_m:.0f} m before touchdown; come from another side, or higher"
            )


def flared(wanted: Accelerations, flight: Flight, ground_m: float, airframe: Airframe) -> Accelerations:
    """The accelerations of the approach, or those of the flare once it sinks faster than that would near the ground."""
    _, _, v_z = ground_velocity(flight)
    sink = TOUCHDOWN_SINK_M_S + FLARE_SINK_1_S * max(flight.air.h - ground_m, 0.0)
    if -v_z <= sink:
        return wanted
    return wanted._replace(
        ahead=speed_acceleration(airframe.airspeed_min_m_s, flight.air.V),
        up=max(wanted.up, -VELOCITY_GAIN * 2.0 * (v_z + sink)),
    )


def touched_down(flight: Flight, ground_m: float) -> Flight:
    """On its wheels: from here on the state's speed is that over ground."""
    east, north, _ = ground_velocity(flight)
    air = flight.air
    state = AirState(air.x, air.y, ground_m, math.hypot(east, north), 0.0, math.atan2(north, east))
    return Flight(state, Controls(0.0, 0.0, 0.0), flight.gusts, (0.0, 0.0, 0.0), flight.point)


def rolled(flight: Flight, terrain: Terrain) -> Flight:
    """One tick of braking, straight ahead on the ground."""
    air = flight.air
    speed = max(air.V - BRAKING_M_S2 * TICK_S, 0.0)
    x = air.x + TICK_S * speed * math.cos(air.chi)
    y = air.y + TICK_S * speed * math.sin(air.chi)
    state = AirState(x, y, ground_height_m(x, y, terrain), speed, 0.0, air.chi)
    return flight._replace(air=state)
