"""Who gives way to whom, and how: the rule that every vehicle goes by, once a second.

In the dialect that plain Python and numba compute bit for bit alike.
"""

from typing import Any, NamedTuple

from missions.airframe import Airframe
from sitl.avoidance.course import Situation, predict
from sitl.avoidance.intent import AHEAD, KEEPS, YIELDS
from sitl.avoidance.manoeuvre import (
    CLIMB_SLOWER,
    FREE,
    HOLD,
    SINK_M_S,
    Manoeuvre,
    drift_of,
    means,
    pace_of,
    return_speed,
    surplus_of,
)
from sitl.avoidance.nearest import FAR_M, least_distance
from sitl.ticks import TICK_S

ENOUGH = 1.3
"""Safe distances that a manoeuvre is to keep;"""
CLEAR, CLEAR_M_S = 1.4, 1.0
"""that the way back is to keep, and more for each second until then: nobody foresees gusts."""
STAY = 0.1
"""So much better, in safe distances, another manoeuvre is to be where none keeps enough."""
LOST_S = 5.0
"""Who has told nothing for so long is taken to give way to nobody. It may be unheard, and fly as told; or it hangs, and
flies at the pace of one who does. Both count, as far as what was told reaches."""
TOO_LATE = 2
"""Of the own points: no manoeuvre changes the distance before this one."""
NEVER = -1


class Known(NamedTuple):
    """What has been told, by row of the vehicle.

    Attributes:
        stamp: tick of the newest intent; NEVER for none.
        status, alone, points: of that,
        places: and how many points there are.
    """

    stamp: Any
    status: Any
    alone: Any
    places: Any
    points: Any


class Verdict(NamedTuple):
    """What to do, and why: how near a vehicle would come without, and in how many seconds."""

    manoeuvre: Manoeuvre
    distance_m: float
    in_s: float


def has_right_of_way(other: int, own: int, tick: int, known: Known) -> bool:
    """Whether the own vehicle is to give way to another: to smaller system ids, and to who cannot give way.

    Args:
        other, own: rows of vehicles, which stand in order of system id.
    """
    stamp = known.stamp[other]
    if other == own or stamp == NEVER or known.status[other] < YIELDS:
        return False
    return other < own or known.status[other] == KEEPS or (tick - stamp) * TICK_S > LOST_S


def nearest(own: int, tick: int, points: Any, count: int, first: int, known: Known) -> tuple[float, float, int]:
    """The least predicted distance to anyone with right of way, in how many seconds, and to whom (-1 for nobody)."""
    least, at_s, to = FAR_M, 0.0, -1
    for other in range(len(known.stamp)):
        if has_right_of_way(other, own, tick, known):
            age_s = (tick - known.stamp[other]) * TICK_S
            told, places = known.points[other], known.places[other]
            distance, when_s = least_distance(points, count, told, places, age_s, 1.0, first)
            if distance < least:
                least, at_s, to = distance, when_s, other
            if age_s > LOST_S:
                distance, when_s = least_distance(points, count, told, places, age_s, known.alone[other], first)
                if distance < least:
                    least, at_s, to = distance, when_s, other
    return least, at_s, to


def decide(
    own: int,
    tick: int,
    now: Situation,
    manoeuvre: Manoeuvre,
    known: Known,
    separation_m: float,
    airframe: Airframe,
    points: Any,
) -> Verdict:
    """The manoeuvre from the next tick on.

    It gives way when it would come nearer than the safe distance to someone with right of way, by the first of the
    actions that keeps ENOUGH distance, or else by the one that keeps most; and is free again when that would keep it
    CLEAR.

    Args:
        points: room for AHEAD places.
    """
    was, raised = manoeuvre.action, manoeuvre.raised_m
    drift, surplus = drift_of(now, manoeuvre), surplus_of(now, manoeuvre)
    if was != FREE and now.follows:
        drift = return_speed(now, airframe)
    free = Manoeuvre(FREE, 0.0, -SINK_M_S if raised > 0.0 else 0.0, raised, drift, surplus, -1)
    count = predict(pace_of(now, free, separation_m), now, AHEAD, points)
    distance, at_s, other = nearest(own, tick, points, count, 0, known)
    if distance >= (separation_m if was == FREE else CLEAR * separation_m + CLEAR_M_S * at_s):
        return Verdict(free, distance, at_s)
    if was != FREE:
        other = manoeuvre.other
    best, most = free, -1.0
    for action in range(HOLD, CLIMB_SLOWER + 1):
        speed, climb = means(action, now, airframe)
        if action != HOLD and speed == 0.0 and climb == 0.0:
            continue
        tried = Manoeuvre(action, speed, climb, raised, drift, surplus, other)
        count = predict(pace_of(now, tried, separation_m), now, AHEAD, points)
        kept, _, _ = nearest(own, tick, points, count, TOO_LATE, known)
        if kept >= ENOUGH * separation_m:
            return Verdict(tried, distance, at_s)
        if action == was:
            kept += STAY * separation_m
        if kept > most:
            best, most = tried, kept
    return Verdict(best, distance, at_s)
