"""Corrections over Zenoh in real time: nobody waits; what has come by a tick is what there is."""

from collections.abc import Callable, Iterable, Mapping
from functools import partial

import zenoh

from sitl.formation.arrivals import Arrivals
from sitl.formation.channel import DRAWS
from sitl.formation.correction import Correction, encode
from sitl.formation.exchange import Exchange
from sitl.formation.link_report import LinkReport
from sitl.formation.network import Network
from sitl.noise import uniforms
from sitl.ticks import TICK_S

FUTURE_TICKS = round(1.0 / TICK_S)
"""A sample that is so far ahead of the clock is not believed: clocks of several machines agree better than that."""


class LiveExchange(Exchange):
    """An exchange that takes the time of each sample's arrival instead of waiting for it.

    Args:
        session, swarm, delays: as of an `Exchange`.
        network: of the swarm.
        seed: of what its channels do.
        now_ticks: the clock of all, as ticks of simulated time; asked from Zenoh's threads too.
    """

    congestion = zenoh.CongestionControl.DROP

    def __init__(
        self,
        session: zenoh.Session,
        swarm: str,
        delays: Mapping[int, Mapping[int, int]],
        network: Network,
        seed: int,
        now_ticks: Callable[[], float],
    ) -> None:
        self._network = network
        self._seed = seed
        self._now_ticks = now_ticks
        self._arrivals: dict[tuple[int, int], Arrivals] = {}
        super().__init__(session, swarm, delays)

    def listen(self, sysid: int, delays: Mapping[int, int]) -> None:
        """Listen to the neighbours of a vehicle of this process."""
        super().listen(sysid, delays)
        for neighbour in delays:
            if (neighbour, sysid) not in self._arrivals:
                self._arrivals[neighbour, sysid] = self._link(neighbour, sysid)

    def publish(self, sample: Correction, *, now: bool = True) -> None:
        """Tell the neighbours an own vehicle's deviation, always at once."""
        self._publishers[sample.sysid].put(encode(sample))
        self._arrive([sample], self._now_ticks())

    def gather(self, tick: int) -> None:
        """Take in all that has come by now."""
        self._tick = tick
        while not self.inbox.empty():
            self.inbox.get()()

    def heard_by(self, sysid: int) -> dict[int, Correction]:
        """What begins to count at the tick gathered for, by neighbour of one of the process's vehicles."""
        newest = {other: self._arrivals[other, sysid].newest(self._tick) for other in self._delays[sysid]}
        return {other: sample for other, sample in newest.items() if sample is not None}

    def reports(self, sysid: int) -> tuple[LinkReport, ...]:
        """What came of the links to a vehicle of this process."""
        return tuple(self._report(other, sysid) for other in sorted(self._delays[sysid]))

    def _report(self, sender: int, receiver: int) -> LinkReport:
        link = self._arrivals[sender, receiver]
        return LinkReport(
            sender,
            receiver,
            self._refused(sender),
            link.heard,
            link.late,
            link.lost,
            link.delay_mean_s,
            link.delay_max_s,
        )

    def _link(self, sender: int, receiver: int) -> Arrivals:
        channel = self._network.channel_of(sender, receiver)
        draws = None if channel.certain else uniforms(self._seed, sender, receiver, DRAWS)
        return Arrivals(channel, draws, self._network.silences(sender, receiver))

    def _greet(self) -> None:
        """Nobody waits for us."""

    def _arrive(self, samples: Iterable[Correction], now_ticks: float) -> None:
        for sample in samples:
            for (sender, _), link in self._arrivals.items():
                if sender == sample.sysid:
                    link.arrive(sample, now_ticks)

    def _sample_putter(self, neighbour: int) -> Callable[[zenoh.Sample], None]:
        def put(sample: zenoh.Sample) -> None:
            self.inbox.put(partial(self._let_in, neighbour, sample.payload.to_bytes(), self._now_ticks()))

        return put

    def _let_in(self, neighbour: int, payload: bytes, now_ticks: float) -> None:
        self._arrive(self._doors[neighbour].admit(payload, int(now_ticks) + FUTURE_TICKS), now_ticks)
