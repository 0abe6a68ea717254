"""The swarm's clock: the schedule slows down for all when one vehicle can go no faster, and hurries when one can go no
slower. Wind that nobody foresaw then costs time, and not the formation.

Each vehicle keeps two sums, of what its schedule has been slowed and of what it has been hurried since the launch. Both
only grow: as fast as the vehicle itself leaves its schedule with its speed at a limit, or as fast as the neighbours
would have it. So all sums go where the greatest is, whatever the delay; nobody needs to know whose it is.

The functions keep to the dialect that plain Python and numba compute bit for bit alike.
"""

from typing import NamedTuple

from missions.airframe import Airframe, thrust_max_n
from sitl.aircraft.point_mass import AirState, Controls
from sitl.guidance.path_errors import ScheduleClock
from sitl.guidance.path_law import SPEED_MARGIN_M_S, clamp
from sitl.ticks import TICK_S

MOST = 0.3
"""The greatest rate of a shift: no schedule goes slower than 0.7 times its speed, or faster than 1.3 times."""
FROM_M = 3.0
"""A vehicle whose speed is at its limit begins to shift its schedule when it is so far from it;"""
PER_M = 0.05
"""and by so much more a metre, 1/m."""
PULL = 0.5
"""1/s, from what a neighbour's sum is greater to the rate at which the own one grows."""
HANDED_ON = 0.95
"""The share of a neighbour's rate that a vehicle takes over. With all of it two would keep each other at it."""
SMOOTH_S = 0.5
"""Time constant of the rate."""
FULL_THRUST, NO_THRUST = 0.97, 0.03
"""Shares of what the engine gives: no more, or no less, is to be had."""
SPEED_ROOM_M_S = 0.1
"""So near to the least and the greatest airspeed that the law asks for, a vehicle goes no slower and no faster."""


class Shift(NamedTuple):
    """By how much a schedule is moved, one way.

    Attributes:
        sum_s: since the launch.
        rate: of its growth, s/s, at most `MOST`.
        change: of the rate, 1/s.
    """

    sum_s: float
    rate: float
    change: float


class Shifts(NamedTuple):
    """Both ways: how much later it is, and how much earlier."""

    slowed: Shift
    hurried: Shift


UNSHIFTED = Shifts(Shift(0.0, 0.0, 0.0), Shift(0.0, 0.0, 0.0))


def schedule_clock(time_s: float, shifts: Shifts) -> ScheduleClock:
    """What a schedule's clock shows at a time since the launch."""
    slowed, hurried = shifts
    return ScheduleClock(
        time_s - slowed.sum_s + hurried.sum_s, 1.0 - slowed.rate + hurried.rate, hurried.change - slowed.change
    )


def own_needs(along_m: float, air: AirState, controls: Controls, airframe: Airframe) -> tuple[float, float]:
    """The rates at which a vehicle itself would have the schedule slow down, and hurry."""
    most_n = thrust_max_n(air.V, airframe)
    fastest = airframe.airspeed_max_m_s - SPEED_ROOM_M_S
    slowest = airframe.airspeed_min_m_s + SPEED_MARGIN_M_S + SPEED_ROOM_M_S
    slow = hurry = 0.0
    if along_m < -FROM_M and (controls.thrust >= FULL_THRUST * most_n or fastest <= air.V):
        slow = (-along_m - FROM_M) * PER_M
    if along_m > FROM_M and (controls.thrust <= NO_THRUST * most_n or slowest >= air.V):
        hurry = (along_m - FROM_M) * PER_M
    return slow, hurry


def neighbours_need(sum_s: float, other_sum_s: float, other_rate: float) -> float:
    """The rate at which a neighbour would have the own sum grow.

    What it says is old, the own sum is of now: as sums only grow, nobody is pulled beyond where the other is. (Carried
    on to now by its rate it would be: two pulled each other on for ever, at a delay of a second.)
    """
    return HANDED_ON * other_rate + PULL * (other_sum_s - sum_s)


def grown(shift: Shift, need: float) -> Shift:
    """A shift at the next tick."""
    change = (clamp(need, 0.0, MOST) - shift.rate) / SMOOTH_S
    rate = shift.rate + change * TICK_S
    return Shift(shift.sum_s + rate * TICK_S, rate, change)


def longest_s(duration_s: float) -> float:
    """How long a schedule takes at the most."""
    return duration_s / (1.0 - MOST)
