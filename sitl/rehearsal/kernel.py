"""The swarm's flight, tick by tick: what endpoints do in a held flight, in the same order, for all of them at once.

Written for the compiler, in the dialect that plain Python computes bit for bit alike.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.reference.reference import ReferenceTables
from sitl.aircraft.gusts import GustState
from sitl.aircraft.point_mass import AirState, Controls
from sitl.avoidance.course import Situation
from sitl.avoidance.manoeuvre import AS_PLANNED, FREE, aside, yielding_acceleration
from sitl.flight import (
    Aircraft,
    Flight,
    airspeed_at,
    at_point,
    ground_velocity,
    in_next_wind,
    launched,
    moved,
    path_accelerations,
)
from sitl.formation.failures import within
from sitl.formation.law import Gains, correction, formation_acceleration
from sitl.formation.link import NEVER, trusted, waiting
from sitl.formation.swarm_clock import Shift, Shifts, grown, neighbours_need, own_needs, schedule_clock
from sitl.guidance.loiter_law import Approach, Loiter, loiter_accelerations, on_approach, to_go_m
from sitl.guidance.path_errors import PathPoint, path_errors
from sitl.guidance.path_law import PLANNED_ROOM_M_S, speed_acceleration, speed_before_height
from sitl.rehearsal.avoiding import Avoiding, begin, tell_and_learn
from sitl.rehearsal.hearing import Hearing, epoch_at, hearing_of
from sitl.rehearsal.record import Record
from sitl.rehearsal.wiring import Wiring
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

ON_PATH, CIRCLING = 0, 1
MORE_TICKS = 50
"""Flown after the last arrival, so that the crossing of the target's plane is on record."""
STATE_FIELDS = 27
"""Of a `Flight` and its `Shifts`, in a row."""


class Routes(NamedTuple):
    """What n vehicles fly: routes 0 to n - 1, and more that some change to in flight, r in all. Tables of all routes
    stand one below the other; those of route i are rows [first[i], first[i + 1]).

    Attributes:
        segments, altitude, schedule, airspeeds: as in `ReferenceTables`.
        first_segment, first_altitude, first_schedule, first_airspeed: (r + 1,).
        length_m, duration_s: (r,).
        end_s_m: (r,) arc length of the last corner, where the circle begins.
        circle: (r, 5) rows of a `Loiter`.
        home_m: (n, 3).
        changes: (r - n, 3) tick, vehicle and route that it changes to if it is still on its path, in order of tick.
    """

    segments: FloatArray
    first_segment: IntArray
    altitude: FloatArray
    first_altitude: IntArray
    schedule: FloatArray
    first_schedule: IntArray
    airspeeds: FloatArray
    first_airspeed: IntArray
    length_m: FloatArray
    duration_s: FloatArray
    end_s_m: FloatArray
    circle: FloatArray
    home_m: FloatArray
    changes: IntArray


class Law(NamedTuple):
    """The formation law, and whether it is on (`plain` is the autopilot's airspeed hold).

    Attributes:
        gains: (n, 4) rows of a `Gains`.
        swarm_clock: the schedule is slowed and hurried with the neighbours'.
    """

    gains: FloatArray
    plain: bool
    swarm_clock: bool


def fly_swarm(
    routes: Routes,
    aircraft: Aircraft,
    wiring: Wiring,
    law: Law,
    normals: FloatArray,
    draws: FloatArray,
    avoiding: Avoiding | None,
    record: Record,
) -> int:
    """Fly until all have arrived or are gone, and a little longer, or the record is full.

    Args:
        normals: (n, ticks, 5) draws for the gusts.
        draws: for the channels, of `draws_of`.
        avoiding: how vehicles give way; None, and they do not: that much less is compiled.
        record: takes what comes to pass.

    Returns:
        How many ticks were flown.
    """
    ticks = normals.shape[1]
    state = np.zeros((len(routes.home_m), STATE_FIELDS))
    stage = np.zeros((len(routes.home_m), 4))
    hearing = hearing_of(wiring, draws, ticks)
    route = np.arange(len(routes.home_m))
    start = int(route[0])  # 0, but no literal: for that `fly_one` would be compiled once more
    changed = 0
    while start < ticks and (underway(start, wiring, record) or start < record.arrived.max() + MORE_TICKS):
        # The delay is the lookahead: a vehicle may run ahead of its neighbours by so much.
        end = min(start + wiring.lookahead_ticks, ticks)
        while changed < len(routes.changes) and routes.changes[changed, 0] <= start:
            p = routes.changes[changed, 1]
            if stage[p, 0] == ON_PATH:
                route[p] = routes.changes[changed, 2]
                state[p, 18] = state[p, 19] = state[p, 20] = 0.0  # the place in the tables is found anew
            changed += 1
        if changed < len(routes.changes):
            end = min(end, routes.changes[changed, 0])
        for p in range(len(routes.home_m)):
            r = route[p]
            fly_one(p, r, start, end, routes, aircraft, wiring, law, normals, state, stage, hearing, avoiding, record)
        start = end
    return start


def underway(tick: int, wiring: Wiring, record: Record) -> bool:
    """Whether anyone has yet to arrive."""
    for p in range(len(wiring.death)):  # noqa: SIM110 (numba knows no any())
        if record.arrived[p] < 0 and tick < wiring.death[p]:
            return True
    return False


def fly_one(
    p: int,
    route: int,
    start: int,
    end: int,
    routes: Routes,
    aircraft: Aircraft,
    wiring: Wiring,
    law: Law,
    normals: FloatArray,
    state: FloatArray,
    stage: FloatArray,
    hearing: Hearing,
    avoiding: Avoiding | None,
    record: Record,
) -> None:
    """Fly vehicle p along a route through ticks [start, end).

    Args:
        state: (n, STATE_FIELDS) flights and shifts as of `start`.
        stage: (n, 4): ON_PATH or CIRCLING, the approach to the circle, the airspeed on it.
    """
    flight = flight_in(state[p])
    slowed = Shift(state[p, 21], state[p, 22], state[p, 23])
    hurried = Shift(state[p, 24], state[p, 25], state[p, 26])
    tables = tables_of(route, routes)
    circle = routes.circle[route]
    loiter = Loiter(circle[0], circle[1], circle[2], circle[3], circle[4])
    own = law.gains[p]
    gains = Gains(own[0], own[1], own[2], own[3])
    freezes = wiring.freeze[wiring.first_freeze[p] : wiring.first_freeze[p + 1]]
    epoch = 0
    for tick in range(start, min(end, wiring.death[p])):
        gust_draws = (
            normals[p, tick, 0],
            normals[p, tick, 1],
            normals[p, tick, 2],
            normals[p, tick, 3],
            normals[p, tick, 4],
        )
        if tick == 0:
            home = routes.home_m[p]
            flight = launched((home[0], home[1], home[2]), tables, gust_draws, aircraft)
        else:
            flight = in_next_wind(flight, gust_draws, aircraft)
        air = flight.air
        for i in range(6):
            record.truth[p, tick, i] = air[i]
        position = (air.x, air.y, air.h)
        velocity = ground_velocity(flight)
        if stage[p, 0] == ON_PATH:
            clock = schedule_clock(tick * TICK_S, Shifts(slowed, hurried))
            errors, point = path_errors(position, velocity, clock, flight.point, tables)
            flight = at_point(flight, point)
            able = not within(tick, freezes)
            manoeuvre = AS_PLANNED
            if avoiding is not None:
                manoeuvre = begin(p, tick, able, avoiding)
            in_formation = able and manoeuvre.action == FREE
            record.in_formation[p, tick] = in_formation
            record.along_m[p, tick] = errors.along
            record.along_rate_m_s[p, tick] = errors.along_rate
            if law.swarm_clock:
                shifts = record.shifts[p, tick]
                shifts[0], shifts[1], shifts[2], shifts[3] = slowed.sum_s, slowed.rate, hurried.sum_s, hurried.rate
            epoch = epoch_at(tick, epoch, wiring.epoch)
            # This loop is not a function: the tables take longer to hand over than to use.
            corrections = slow = hurry = 0.0
            for link in range(wiring.first_link[p], wiring.first_link[p + 1]):
                weight, trust, stamp = wiring.weight[epoch, link], hearing.trust[link], hearing.newest[link, tick]
                oldest_ticks = wiring.delay_ticks[link] + wiring.jitter_ticks[link] + wiring.stale_ticks
                if stamp == NEVER:
                    hearing.trust[link] = waiting(trust, tick <= oldest_ticks and weight > 0.0)
                    continue
                q = wiring.sender[link]
                flying = in_formation and record.in_formation[p, stamp] and record.in_formation[q, stamp]
                used = flying and weight > 0.0 and tick - stamp <= oldest_ticks
                if used:
                    corrections += correction(
                        record.along_m[p, stamp],
                        record.along_rate_m_s[p, stamp],
                        record.along_m[q, stamp],
                        record.along_rate_m_s[q, stamp],
                        weight * trust,
                        gains,
                    )
                    if law.swarm_clock:
                        other = record.shifts[q, stamp]
                        slow = max(slow, neighbours_need(slowed.sum_s, other[0], other[1]))
                        hurry = max(hurry, neighbours_need(hurried.sum_s, other[2], other[3]))
                hearing.trust[link] = trusted(trust, used)
                record.used[link, tick] = used
            airspeed = airspeed_at(point.s_m, tables.airspeeds)
            if avoiding is not None:
                end_s_m, follows = routes.end_s_m[route], not law.plain
                here = Situation(position, errors, point, air.V, airspeed, clock, end_s_m, follows, tables)
                tell_and_learn(p, tick, able, here, manoeuvre, aircraft.airframe, avoiding)
            if manoeuvre.action != FREE:
                ahead = yielding_acceleration(errors, manoeuvre, airspeed, air.V, not law.plain)
            elif law.plain or not in_formation:
                ahead = speed_acceleration(airspeed, air.V)
            else:
                ahead = formation_acceleration(errors, corrections, gains)
            if law.swarm_clock:
                if in_formation:
                    own_slow, own_hurry = own_needs(errors.along, air, flight.controls, aircraft.airframe)
                    slow, hurry = max(own_slow, slow), max(own_hurry, hurry)
                slowed, hurried = grown(slowed, slow), grown(hurried, hurry)
            if manoeuvre.raised_m > 0.0:
                errors = aside(errors, manoeuvre)
            wanted = path_accelerations(errors, ahead, air.V, aircraft.airframe)
            flight = moved(flight, wanted, aircraft)
            if point.s_m >= routes.end_s_m[route]:
                record.arrived[p] = tick
                stage[p, 0] = CIRCLING
                stage[p, 1] = -1.0
                stage[p, 3] = airspeed_at(point.s_m, tables.airspeeds)
        else:
            if stage[p, 1] < 0.0:
                stage[p, 1] = to_go_m(air.x, air.y, loiter)
                stage[p, 2] = air.h
            now = on_approach(air.x, air.y, loiter, Approach(stage[p, 2], stage[p, 1]))
            wanted = loiter_accelerations(position, velocity, air.V, stage[p, 3], now)
            wanted = speed_before_height(wanted, air.V, PLANNED_ROOM_M_S, aircraft.airframe)
            flight = moved(flight, wanted, aircraft)
        record.thrust_n[p, tick] = flight.controls.thrust
    keep(flight, state[p])
    state[p, 21], state[p, 22], state[p, 23] = slowed
    state[p, 24], state[p, 25], state[p, 26] = hurried


def tables_of(route: int, routes: Routes) -> ReferenceTables:
    """The tables of one route."""
    return ReferenceTables(
        routes.segments[routes.first_segment[route] : routes.first_segment[route + 1]],
        routes.altitude[routes.first_altitude[route] : routes.first_altitude[route + 1]],
        routes.schedule[routes.first_schedule[route] : routes.first_schedule[route + 1]],
        routes.airspeeds[routes.first_airspeed[route] : routes.first_airspeed[route + 1]],
        routes.length_m[route],
        routes.duration_s[route],
    )


def flight_in(row: FloatArray) -> Flight:
    """The flight that `keep` has put into a row."""
    return Flight(
        AirState(row[0], row[1], row[2], row[3], row[4], row[5]),
        Controls(row[6], row[7], row[8]),
        GustState(row[9], row[10], row[11], row[12], row[13]),
        (row[14], row[15], row[16]),
        PathPoint(row[17], int(row[18]), int(row[19]), int(row[20])),
    )


def keep(flight: Flight, row: FloatArray) -> None:
    """Put a flight into a row."""
    air, controls, gusts, wind, point = flight.air, flight.controls, flight.gusts, flight.wind, flight.point
    row[0], row[1], row[2], row[3], row[4], row[5] = air.x, air.y, air.h, air.V, air.gamma, air.chi
    row[6], row[7], row[8] = controls.thrust, controls.lift, controls.bank
    row[9], row[10], row[11], row[12], row[13] = gusts.along, gusts.across_1, gusts.across_2, gusts.up_1, gusts.up_2
    row[14], row[15], row[16] = wind
    row[17], row[18], row[19], row[20] = point.s_m, point.segment, point.altitude_piece, point.schedule_piece
