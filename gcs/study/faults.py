"""Random schedules of what fails in flight: kills, freezes, splits, silences, and bursts of loss."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from missions.scenario.network import BurstModel, ChannelModel, FailureModel
from sitl.formation.failures import Kind

MOST_FAILURES = 4
MOST_KILLED = 3
SHORTEST_S, LONGEST_S = 2.0, 120.0
"""Of a failure that ends."""
SILENT_ALL = 0.3
"""Share of the silences that are everyone's."""
KINDS: tuple[Kind, ...] = ("kill", "freeze", "silence", "split")


@dataclass(frozen=True)
class Faults:
    """One schedule.

    Attributes:
        seed: that it was drawn with.
        channel: of every link.
        failures: in order of drawing.
    """

    seed: int
    channel: ChannelModel
    failures: tuple[FailureModel, ...]

    def as_json(self) -> dict[str, Any]:
        """As a scenario's file has it."""
        return {
            "seed": self.seed,
            "channel": self.channel.model_dump(exclude_none=True),
            "failures": [failure.model_dump(exclude_defaults=True) for failure in self.failures],
        }


def draw_faults(seed: int, sysids: Sequence[int], duration_s: float) -> Faults:
    """Draw up to four failures within a flight, and in every other schedule bursts of loss from beginning to end.

    At most three vehicles are killed, and at least two are left.

    Args:
        seed: the same schedule for the same seed.
        sysids: of the vehicles, at least three.
        duration_s: of the flight.
    """
    rng = np.random.default_rng([seed, 0xFA])
    killable = list(rng.permutation(sorted(sysids))[: min(MOST_KILLED, len(sysids) - 2)])
    failures = []
    for _ in range(int(rng.integers(1, MOST_FAILURES + 1))):
        what = KINDS[rng.integers(len(KINDS))]
        at_s = round(float(rng.uniform(0.0, duration_s)), 2)
        for_s = round(float(np.exp(rng.uniform(np.log(SHORTEST_S), np.log(LONGEST_S)))), 2)
        some = sorted(int(one) for one in rng.permutation(sorted(sysids))[: rng.integers(1, len(sysids) // 2 + 1)])
        if what == "kill":
            if killable:
                failures.append(FailureModel(what="kill", at_s=at_s, vehicles=(int(killable.pop()),)))
        elif what == "split":
            failures.append(FailureModel(what="split", at_s=at_s, for_s=for_s, groups=(tuple(some),)))
        elif what == "silence" and rng.random() < SILENT_ALL:
            failures.append(FailureModel(what="silence", at_s=at_s, for_s=for_s))
        else:
            failures.append(FailureModel(what=what, at_s=at_s, for_s=for_s, vehicles=tuple(some)))
    return Faults(seed, _channel(rng), tuple(failures))


def _channel(rng: np.random.Generator) -> ChannelModel:
    if rng.random() < 0.5:
        return ChannelModel()
    every_s, length_s, loss = rng.uniform(5.0, 60.0), rng.uniform(0.5, 10.0), rng.uniform(0.5, 1.0)
    return ChannelModel(
        jitter_s=round(float(rng.uniform(0.0, 0.3)), 2),
        loss=round(float(rng.uniform(0.0, 0.3)), 3),
        bursts=BurstModel(every_s=round(every_s, 2), length_s=round(length_s, 2), loss=round(loss, 3)),
    )
