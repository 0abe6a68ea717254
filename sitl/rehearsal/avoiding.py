"""How vehicles give way in the kernel: as `sitl.avoidance.avoider` has it, for tables.

Written for the compiler, over the functions that endpoints call.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.airframe import Airframe
from sitl.avoidance.course import Situation, predict
from sitl.avoidance.intent import GROUNDED, PERIOD_TICKS, POINTS, QUIET, YIELDS
from sitl.avoidance.manoeuvre import FREE, Manoeuvre, going_on, pace_alone, pace_of
from sitl.avoidance.rule import NEVER, Known, decide
from sitl.formation.channel import LOST, Channel, carried
from sitl.formation.failures import within

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

MANOEUVRE_FIELDS = 7


class Avoiding(NamedTuple):
    """What n vehicles tell, hear and do at k periods.

    Attributes:
        separation_m: the safe distance.
        heard: (n, n, k) of each receiver and sender, the period of the newest intent heard by a period; -1 for none.
        status, alone, places, points: (n, k), (n, k), (n, k), (n, k, POINTS, 3) of each intent; and how many points
            there are.
        manoeuvre: (n, MANOEUVRE_FIELDS) of the next tick.
        known: room for what one of them has been told.
        room: (POINTS, 3) for predictions.
        other: (n, ticks) row of whom it gives way to; -1 for nobody.
        foreseen: (n, k, 2) how near it would come, and in how many seconds.
    """

    separation_m: float
    heard: IntArray
    status: IntArray
    alone: FloatArray
    places: IntArray
    points: FloatArray
    manoeuvre: FloatArray
    known: Known
    room: FloatArray
    other: IntArray
    foreseen: FloatArray


class IntentWiring(NamedTuple):
    """Who hears whose intents. Links are ordered by receiver, then by sender; there are n (n - 1).

    Attributes:
        sender, receiver: rows.
        channel: (links, 6) of a `Channel`, as intents meet it.
        certain: (links,) whether no draws are needed.
        silence, first_silence: (m, 2) intervals, those of each link from its first on.
        gone: (n,) tick from which on it is known that a vehicle is gone.
    """

    sender: IntArray
    receiver: IntArray
    channel: FloatArray
    certain: npt.NDArray[np.bool_]
    silence: IntArray
    first_silence: IntArray
    gone: IntArray


def let_intents_through(
    wiring: IntentWiring, freeze: IntArray, first_freeze: IntArray, draws: FloatArray, heard: IntArray
) -> None:
    """Fill `heard`, which is -1 everywhere: it does not depend on the flight.

    Args:
        draws: (links, k, DRAWS).
    """
    periods = heard.shape[2]
    for link in range(len(wiring.sender)):
        q, p = wiring.sender[link], wiring.receiver[link]
        row = wiring.channel[link]
        channel = Channel(int(row[0]), int(row[1]), row[2], row[3], row[4], row[5])
        silences = wiring.silence[wiring.first_silence[link] : wiring.first_silence[link + 1]]
        freezes = freeze[first_freeze[q] : first_freeze[q + 1]]
        in_burst = False
        for k in range(periods):
            stamp, delay = k * PERIOD_TICKS, channel.delay_ticks
            if not wiring.certain[link]:
                in_burst, delay = carried(in_burst, (draws[link, k, 0], draws[link, k, 1], draws[link, k, 2]), channel)
            if delay == LOST or within(stamp, silences) or within(stamp, freezes):
                continue
            by = (stamp + delay + PERIOD_TICKS - 1) // PERIOD_TICKS
            if by < periods:
                heard[p, q, by] = max(heard[p, q, by], k)
        for k in range(1, periods):
            heard[p, q, k] = max(heard[p, q, k], heard[p, q, k - 1])
        for k in range(periods):
            if k * PERIOD_TICKS >= wiring.gone[q]:
                heard[p, q, k] = -1


def begin(p: int, tick: int, able: bool, avoiding: Avoiding) -> Manoeuvre:
    """The manoeuvre of a vehicle at a tick."""
    row = avoiding.manoeuvre[p]
    manoeuvre = Manoeuvre(FREE, 0.0, 0.0, 0.0, 0.0, 0.0, -1)
    if able:
        manoeuvre = Manoeuvre(int(row[0]), row[1], row[2], row[3], row[4], row[5], int(row[6]))
        manoeuvre = going_on(manoeuvre, avoiding.separation_m)
    keep_manoeuvre(manoeuvre, row)
    avoiding.other[p, tick] = manoeuvre.other
    return manoeuvre


def tell_and_learn(
    p: int, tick: int, able: bool, now: Situation, manoeuvre: Manoeuvre, airframe: Airframe, avoiding: Avoiding
) -> None:
    """Where intents are due, tell what vehicle p on its path intends, and decide what it does from the next tick on."""
    if tick % PERIOD_TICKS != 0:
        return
    k = tick // PERIOD_TICKS
    separation_m, known = avoiding.separation_m, avoiding.known
    avoiding.status[p, k] = YIELDS if able else QUIET
    if not able:
        return
    avoiding.places[p, k] = predict(pace_of(now, manoeuvre, separation_m), now, POINTS, avoiding.points[p, k])
    avoiding.alone[p, k] = pace_alone(now, manoeuvre)
    for q in range(len(avoiding.status)):
        j = avoiding.heard[p, q, k]
        known.stamp[q] = NEVER
        if j >= 0:
            known.stamp[q] = j * PERIOD_TICKS
            known.status[q], known.places[q] = avoiding.status[q, j], avoiding.places[q, j]
            known.alone[q], known.points[q] = avoiding.alone[q, j], avoiding.points[q, j]
    verdict = decide(p, tick, now, manoeuvre, known, separation_m, airframe, avoiding.room)
    keep_manoeuvre(verdict.manoeuvre, avoiding.manoeuvre[p])
    avoiding.foreseen[p, k, 0], avoiding.foreseen[p, k, 1] = verdict.distance_m, verdict.in_s


def keep_manoeuvre(manoeuvre: Manoeuvre, row: FloatArray) -> None:
    """Put a manoeuvre into a row of MANOEUVRE_FIELDS numbers."""
    row[0], row[1], row[2] = manoeuvre.action, manoeuvre.speed_m_s, manoeuvre.climb_m_s
    row[3], row[4], row[5] = manoeuvre.raised_m, manoeuvre.drift_m_s, manoeuvre.surplus_m_s
    row[6] = manoeuvre.other


def empty_avoiding(separation_m: float, vehicles: int, ticks: int) -> Avoiding:
    """Nothing told yet, with room for a flight of some ticks."""
    n, k = vehicles, -(-ticks // PERIOD_TICKS)
    manoeuvre = np.zeros((n, MANOEUVRE_FIELDS))
    manoeuvre[:, 6] = -1.0
    return Avoiding(
        separation_m,
        heard=np.full((n, n, k), -1),
        status=np.full((n, k), GROUNDED),
        alone=np.ones((n, k)),
        places=np.zeros((n, k), dtype=np.int64),
        points=np.zeros((n, k, POINTS, 3)),
        manoeuvre=manoeuvre,
        known=Known(
            np.full(n, NEVER), np.full(n, QUIET), np.ones(n), np.zeros(n, dtype=np.int64), np.zeros((n, POINTS, 3))
        ),
        room=np.zeros((POINTS, 3)),
        other=np.full((n, ticks), -1),
        foreseen=np.zeros((n, k, 2)),
    )
