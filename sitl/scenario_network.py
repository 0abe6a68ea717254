"""The network that a scenario describes."""

from collections.abc import Sequence

from missions.scenario import Scenario
from missions.scenario.network import BurstModel, FailureModel
from sitl.formation.channel import Channel
from sitl.formation.failures import FOR_EVER, Failure
from sitl.formation.graph import edges
from sitl.formation.network import Network
from sitl.ticks import TICK_S, delay_ticks


def network_of(scenario: Scenario, sysids: Sequence[int], delay_s: float, shift: int = 0) -> Network:
    """The network of a scenario's vehicles.

    Args:
        scenario: whose formation, channel, links and failures count.
        sysids: of the vehicles that fly.
        delay_s: of the links that have none of their own; rounded up to whole ticks, at least one.
        shift: what system ids are larger by than in the scenario.
    """
    formation, channel = scenario.formation, scenario.channel
    common = _channel(delay_s, channel.jitter_s, channel.loss, channel.bursts)
    links = {
        (link.sender + shift, link.receiver + shift): _channel(
            delay_s if link.delay_s is None else link.delay_s,
            channel.jitter_s if link.jitter_s is None else link.jitter_s,
            channel.loss if link.loss is None else link.loss,
            channel.bursts if link.bursts is None else link.bursts,
        )
        for link in scenario.links
    }
    graph = formation.graph
    if not isinstance(graph, str):
        graph = tuple((p + shift, q + shift) for p, q in graph)
    return Network(
        sysids=tuple(sorted(sysids)),
        graph=edges(graph, sysids),
        channel=common,
        links=links,
        failures=tuple(_failure(failure, shift) for failure in scenario.failures),
        stale_ticks=delay_ticks(formation.stale_s),
    )


def _channel(delay_s: float, jitter_s: float, loss: float, bursts: BurstModel | None) -> Channel:
    jitter_ticks = delay_ticks(jitter_s) if jitter_s > 0.0 else 0
    if bursts is None:
        return Channel(delay_ticks(delay_s), jitter_ticks, loss)
    return Channel(
        delay_ticks(delay_s),
        jitter_ticks,
        loss,
        enter=min(1.0, TICK_S / bursts.every_s),
        leave=min(1.0, TICK_S / bursts.length_s),
        burst_loss=bursts.loss,
    )


def _failure(failure: FailureModel, shift: int) -> Failure:
    start = round(failure.at_s / TICK_S)
    return Failure(
        failure.what,
        frozenset(sysid + shift for sysid in failure.vehicles),
        tuple(frozenset(sysid + shift for sysid in group) for group in failure.groups),
        (start, FOR_EVER if failure.for_s is None else start + delay_ticks(failure.for_s)),
    )
