"""What a vehicle hears of its neighbours in the kernel: as `sitl.formation.formation` has it, for tables.

Written for the compiler, over the functions that endpoints call.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from sitl.formation.channel import LOST, Channel, carried
from sitl.formation.failures import within
from sitl.formation.link import NEVER, arrive, newest_heard
from sitl.rehearsal.wiring import Wiring

FloatArray = npt.NDArray[np.float64]


class Hearing(NamedTuple):
    """What comes through each link, and what that is worth.

    Attributes:
        newest: (links, ticks) stamp of the newest sample heard up to a tick. It does not depend on the flight.
        trust: (links,) share of its weight that an edge has by now.
    """

    newest: npt.NDArray[np.int32]
    trust: FloatArray


def hearing_of(wiring: Wiring, draws: FloatArray, ticks: int) -> Hearing:
    """As a flight of so many ticks begins."""
    newest = np.full((len(wiring.sender), ticks), NEVER, dtype=np.int32)
    for link in range(len(newest)):
        let_through(link, wiring, draws, newest[link])
    return Hearing(newest, wiring.trust.copy())


def let_through(link: int, wiring: Wiring, draws: FloatArray, newest: npt.NDArray[np.int32]) -> None:
    """Let all samples of a link through its channel."""
    least_ticks, jitter_ticks, certain = wiring.delay_ticks[link], wiring.jitter_ticks[link], wiring.certain[link]
    chances = wiring.chances[link]
    channel = Channel(least_ticks, jitter_ticks, chances[0], chances[1], chances[2], chances[3])
    silences = wiring.silence[wiring.first_silence[link] : wiring.first_silence[link + 1]]
    arrivals = np.full(jitter_ticks + 1, NEVER)
    in_burst, last = False, NEVER
    for tick in range(least_ticks, len(newest)):
        stamp = tick - least_ticks
        delay = least_ticks
        if not certain:
            draw = (draws[link, stamp, 0], draws[link, stamp, 1], draws[link, stamp, 2])
            in_burst, delay = carried(in_burst, draw, channel)
        if delay != LOST and not within(stamp, silences):
            arrive(stamp, stamp + delay, arrivals)
        last = newest_heard(tick, last, arrivals)
        newest[tick] = last


def epoch_at(tick: int, before: int, starts: npt.NDArray[np.int64]) -> int:
    """Which graph holds at a tick, from that of an earlier one; they begin at these ticks."""
    while before + 1 < len(starts) and starts[before + 1] <= tick:
        before += 1
    return before
