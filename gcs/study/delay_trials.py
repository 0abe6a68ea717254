"""The flights of a study of delay: who flies what."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import get_args

from gcs.delay_margin import delay_margin_s
from gcs.study.graphs import Graph
from gcs.study.linear_sweep import PIN_ALL, PIN_ONE, with_pins
from gcs.study.trial import Trial, trial_of
from missions.scenario import Scenario
from missions.scenario.network import BurstModel, ChannelModel
from sitl.config import Arm
from sitl.ticks import TICK_S

SHARES = (0.3, 0.6, 0.8, 0.95, 1.05, 1.2, 1.4, 1.7, 2.0)
"""Of the aircraft's margin."""
QUICK_SHARES = (0.3, 0.95, 1.05, 1.4, 2.0)
JITTERS_S = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.4, 2.0)
LOSSES = (0.0, 0.3, 0.6, 0.8, 0.9, 0.95, 0.98)
BURSTS_S = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0)
"""Mean lengths; as much time passes, in the mean, between two bursts."""


def with_graph(scenario: Scenario, graph: Graph, delay_s: float | None = None) -> Scenario:
    """The scenario with another graph, and another delay if there is one."""
    changes = {"graph": graph, "delay_s": scenario.formation.delay_s if delay_s is None else delay_s}
    return scenario.model_copy(update={"formation": scenario.formation.model_copy(update=changes)})


def delays_s(margin_s: float, shares: Sequence[float]) -> list[float]:
    """Whole ticks near shares of a margin, those below it rounded down, and those above it up."""
    ticks = (margin_s * share / TICK_S for share in shares)
    return [
        round(TICK_S * max(1, math.floor(tick) if share < 1.0 else math.ceil(tick)), 6)
        for tick, share in zip(ticks, shares, strict=True)
    ]


def delay_trials(
    scenario: Scenario, graphs: Mapping[str, Graph], shares: Sequence[float], seeds: Sequence[int]
) -> list[Trial]:
    """Curves (graph, arm) over delay, s; the arms that hear nobody are flown with the first delay alone."""
    trials = []
    for name, graph in graphs.items():
        swept = delays_s(delay_margin_s(with_graph(scenario, graph)), shares)
        for arm in get_args(Arm):
            for delay_s in dict.fromkeys(swept if arm == "full" else swept[:1]):
                changed = with_graph(scenario, graph, delay_s)
                trials += [trial_of(changed, (name, arm), delay_s, seed, arm) for seed in seeds]
    return trials


def channel_trials(scenario: Scenario, seeds: Sequence[int]) -> list[Trial]:
    """Curves (what,) over jitter, s, loss a sample, and mean length of bursts, s, at the scenario's delay; and
    ("own_schedule",), which hears nothing."""
    still = ChannelModel()
    swept = [("jitter", level, still.model_copy(update={"jitter_s": level})) for level in JITTERS_S]
    swept += [("loss", level, still.model_copy(update={"loss": level})) for level in LOSSES]
    swept += [
        ("bursts", level, still.model_copy(update={"bursts": BurstModel(every_s=level, length_s=level)}))
        for level in BURSTS_S
    ]
    trials = [
        replace(trial_of(scenario, (what,), level, seed), channel=channel)
        for what, level, channel in swept
        for seed in seeds
    ]
    return trials + [trial_of(scenario, ("own_schedule",), 0.0, seed, "own_schedule") for seed in seeds]


def pin_trials(scenario: Scenario, shares: Sequence[float], seeds: Sequence[int]) -> list[Trial]:
    """Curves (pinned,) over delay, s, on the scenario's graph: all pinned, and the first vehicle alone."""
    swept = dict.fromkeys(delays_s(delay_margin_s(scenario), shares))
    return [
        trial_of(with_pins(with_graph(scenario, scenario.formation.graph, delay_s), who), (who,), delay_s, seed)
        for who in (PIN_ALL, PIN_ONE)
        for delay_s in swept
        for seed in seeds
    ]
