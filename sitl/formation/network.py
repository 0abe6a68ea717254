"""The network of a swarm: who hears whom, through what channels, and what is to fail; the same for all vehicles."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from sitl.formation.channel import Channel
from sitl.formation.failures import FOR_EVER, Failure, Interval, death_tick, frozen, silences
from sitl.formation.graph import Edge, neighbour_weights
from sitl.formation.topology import repaired


@dataclass(frozen=True)
class Network:
    """A swarm's network.

    Attributes:
        sysids: of all vehicles, in order.
        graph: edges, as nothing has happened yet.
        channel: of every link,
        links: but these, by (sender, receiver).
        failures: scheduled.
        stale_ticks: a sample that is older than its channel delays it by so much counts no more.
    """

    sysids: tuple[int, ...]
    graph: tuple[Edge, ...]
    channel: Channel
    links: Mapping[tuple[int, int], Channel] = field(default_factory=dict)
    failures: tuple[Failure, ...] = ()
    stale_ticks: int = 50

    def channel_of(self, sender: int, receiver: int) -> Channel:
        """The channel of a link."""
        return self.links.get((sender, receiver), self.channel)

    def silences(self, sender: int, receiver: int) -> list[Interval]:
        """When nothing comes through a link, by the sender's ticks."""
        return silences(sender, receiver, self.failures)

    def frozen(self, sysid: int) -> list[Interval]:
        """When a vehicle flies as a plain autopilot."""
        return frozen(sysid, self.failures)

    @cached_property
    def deaths(self) -> dict[int, int]:
        """By sysid, the tick at which it is gone, of those that are to be."""
        deaths = {sysid: death_tick(sysid, self.failures) for sysid in self.sysids}
        return {sysid: tick for sysid, tick in deaths.items() if tick < FOR_EVER}

    @cached_property
    def epochs(self) -> tuple[tuple[int, frozenset[int]], ...]:
        """From which tick on who is known to be gone: those whose last sample is too old. The first begins at 0."""
        longest = max(channel.delay_ticks + channel.jitter_ticks for channel in (self.channel, *self.links.values()))
        known = sorted({tick + longest + self.stale_ticks for tick in self.deaths.values()})
        starts = [0, *known]
        return tuple(
            (start, frozenset(i for i, tick in self.deaths.items() if tick + longest + self.stale_ticks <= start))
            for start in starts
        )

    def gone_at(self, tick: int) -> frozenset[int]:
        """Who is known to be gone by schedule."""
        return next(gone for start, gone in reversed(self.epochs) if start <= tick)

    def epoch_end(self, tick: int) -> int:
        """Until which tick nobody else is known to be gone by schedule."""
        return next((start for start, _ in self.epochs if start > tick), FOR_EVER)

    def weights(self, sysid: int, gone: frozenset[int]) -> dict[int, float]:
        """a_pq of a vehicle's neighbours, when these are gone."""
        return neighbour_weights(sysid, repaired(self.graph, gone))

    def neighbours(self, sysid: int) -> tuple[int, ...]:
        """All that a vehicle is a neighbour of at some time, if all goes by schedule; in order."""
        return tuple(sorted({other for _, gone in self.epochs for other in self.weights(sysid, gone)}))

    @cached_property
    def lookahead_ticks(self) -> int:
        """So far any vehicle may run ahead of any other."""
        return min(channel.delay_ticks for channel in (self.channel, *self.links.values()))


def complete(sysids: Sequence[int], graph: Sequence[Edge], delay_ticks: int) -> Network:
    """A network in which nothing is ever lost."""
    return Network(tuple(sysids), tuple(graph), Channel(delay_ticks))
