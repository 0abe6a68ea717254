"""A vehicle's part in the formation: its links, the graph as it knows it, and the corrections that come of both."""

from collections.abc import Iterator, Mapping, Sequence, Set

from sitl.formation.channel import DRAWS
from sitl.formation.correction import Correction
from sitl.formation.disturbance import DISTURBANCE_DRAWS, UNDISTURBED, DelayLine, Disturbance
from sitl.formation.law import Gains
from sitl.formation.link import NO_NEEDS, Link
from sitl.formation.link_state import LinkState
from sitl.formation.live_link import LiveLink
from sitl.formation.network import Network
from sitl.noise import Stream, uniforms
from sitl.ticks import TICK_S


class Formation:
    """Corrections for one vehicle.

    Args:
        sysid: of the vehicle.
        network: of the swarm.
        seed: of what the channels do.
        clocked: the swarm has a clock.
        real_time: what is heard has been through its channel already, and may be late.

    Attributes:
        edges: (tick, neighbour, whether its edge counts from then on), of each change so far.
        needs: the rates at which the neighbours would have the schedule slow down, and hurry; of the last corrections.
        disturbance: in force on all links.
    """

    def __init__(
        self, sysid: int, network: Network, seed: int, *, real_time: bool = False, clocked: bool = False
    ) -> None:
        self.edges: list[tuple[int, int, bool]] = []
        self.needs = NO_NEEDS
        self.disturbance = UNDISTURBED
        self._disturbances: list[Disturbance] = []
        self._sysid = sysid
        self._network = network
        self._seed = seed
        self._real_time = real_time
        self._clocked = clocked
        self._lost: Set[int] = frozenset()
        self._gone: frozenset[int] = frozenset()
        self._until_tick = 0
        self._weights = network.weights(sysid, self._gone)
        self._links = {
            other: self._link(other, trust=float(other in self._weights)) for other in network.neighbours(sysid)
        }
        self._used = dict.fromkeys(self._links, False)

    @property
    def remembers_ticks(self) -> int:
        """How many of its own deviations, up to the present one, a vehicle needs."""
        network = self._network
        channels = (network.channel, *network.links.values())
        return max(channel.delay_ticks + channel.jitter_ticks for channel in channels) + network.stale_ticks + 1

    def lose(self, lost: Set[int]) -> None:
        """These, and no others, are gone, whatever the schedule says."""
        self._lost = lost
        self._until_tick = 0

    def disturb(self, disturbance: Disturbance) -> None:
        """Disturb all links from a tick on that has had no corrections yet. Of two for one tick the later counts."""
        self._disturbances = sorted([*self._disturbances, disturbance], key=lambda one: one.from_tick)
        self._until_tick = 0

    def link_states(self, tick: int) -> tuple[LinkState, ...]:
        """How the links stand, in order of the neighbours' sysids; call it with the tick of the last corrections."""
        states = []
        for other, link in sorted(self._links.items()):
            age = link.age_ticks(tick)
            states.append(LinkState(other, self._sysid, None if age is None else age * TICK_S, link.used, link.trust))
        return tuple(states)

    def neighbours_at(self, tick: int) -> Set[int]:
        """Whose edges count at a tick, as far as it is known who is gone."""
        self._follow(tick)
        return self._weights.keys()

    def corrections(self, tick: int, own: Sequence[Correction], heard: Mapping[int, Correction], gains: Gains) -> float:
        """c of the law (15), the sum over the neighbours; once a tick.

        Args:
            own: the vehicle's deviations, that of this tick last.
            heard: by neighbour, what it said as many ticks ago as its channel delays it; in real time, the newest that
                begins to count at this tick; who said nothing is left out.
        """
        self._follow(tick)
        total = 0.0
        self.needs = NO_NEEDS
        for other, link in self._links.items():
            link.hear(tick, heard.get(other))
            total += link.part(tick, own, self._weights.get(other, 0.0), gains)
            if self._clocked:
                self.needs = (max(self.needs[0], link.needs[0]), max(self.needs[1], link.needs[1]))
            if link.used != self._used[other]:
                self._used[other] = link.used
                self.edges.append((tick, other, link.used))
        return total

    def _follow(self, tick: int) -> None:
        """The graph as of who is gone now, and the disturbance of now; who was not foreseen as a neighbour is listened
        to from now on."""
        if tick < self._until_tick:
            return
        self._until_tick = self._network.epoch_end(tick)
        self._be_disturbed(tick)
        gone = self._network.gone_at(tick) | self._lost
        if gone == self._gone:
            return
        self._gone = gone
        self._weights = self._network.weights(self._sysid, gone)
        for other in self._weights.keys() - self._links.keys():
            self._links[other] = self._link(other, trust=0.0)
            self._used[other] = False
            if self.disturbance is not UNDISTURBED:
                self._disturb(other)

    def _be_disturbed(self, tick: int) -> None:
        """Let the disturbance of a tick come into force."""
        while self._disturbances and self._disturbances[0].from_tick <= tick:
            self.disturbance = self._disturbances.pop(0)
            for other in self._links:
                self._disturb(other)
        if self._disturbances:
            self._until_tick = min(self._until_tick, self._disturbances[0].from_tick)

    def _disturb(self, sender: int) -> None:
        link = self._links[sender]
        if link.line is None:
            draws = uniforms(self._seed, sender, self._sysid, DISTURBANCE_DRAWS, Stream.DISTURBANCES)
            link.line = DelayLine(draws)
        link.line.disturbance = self.disturbance

    def _link(self, sender: int, trust: float) -> Link:
        network, receiver = self._network, self._sysid
        channel = network.channel_of(sender, receiver)
        if self._real_time:
            return LiveLink(channel, None, (), network.stale_ticks, trust, clocked=self._clocked)
        draws: Iterator[tuple[float, ...]] | None = None
        if not channel.certain:
            draws = uniforms(self._seed, sender, receiver, DRAWS)
        return Link(
            channel, draws, network.silences(sender, receiver), network.stale_ticks, trust, clocked=self._clocked
        )
