"""Seeing and disturbing the links of a flying swarm over Zenoh (the queryable `skein/<swarm>/network`)."""

from collections.abc import Iterable
from typing import Any

import zenoh

from gcs.swarm_clock import SwarmClock
from gcs.swarm_query import Answers, ask_swarm
from sitl.formation.link_state import LinkState as LinkState
from sitl.zenoh_session import network_key

LOOK_TIMEOUT_S = 1.0
DISTURB_TIMEOUT_S = 5.0
"""Longer: a disturbance that only some have heard of is worse than one that takes a moment."""


class SwarmNetwork:
    """The links of a swarm. Its calls block, for some milliseconds when all answer.

    Args:
        session: told to connect to all endpoints.
        swarm: the swarm's name.
    """

    def __init__(self, session: zenoh.Session, swarm: str) -> None:
        self._session = session
        self._swarm = swarm
        self._key = network_key(swarm)

    def links(self, sysids: Iterable[int]) -> tuple[LinkState, ...]:
        """How the links to these vehicles stand, in order of receiver and sender; without those to vehicles that have
        not answered within a second."""
        answers = self._tell({}, sysids, LOOK_TIMEOUT_S).of
        return tuple(LinkState(**link) for sysid in sorted(answers) for link in answers[sysid]["links"])

    def disturb(self, delay_s: float, loss: float, sysids: Iterable[int], from_tick: int | None = None) -> int:
        """Add delay and loss to all links, on top of what their channels do, until the next time; 0 and 0 end it.

        It counts from one tick for all, so that the same again from the same tick is the same flight: the clocks stand
        still until all know. In real time, where nobody can hold a clock, it counts for each vehicle from its next.

        Args:
            delay_s: 0 to 60, rounded up to whole ticks.
            loss: probability that a sample is lost.
            sysids: of all vehicles of the swarm that fly.
            from_tick: one that no vehicle has begun; None for the soonest.

        Returns:
            The tick from which it counts, for all.

        Raises:
            InputError: some of them cannot be reached, did not answer or refused; the others may be disturbed.
        """
        sysids = set(sysids)
        clock = SwarmClock(self._session, self._swarm, sysids, LOOK_TIMEOUT_S)
        wanted = {"delay_s": delay_s, "loss": loss, "from_tick": from_tick}
        if from_tick is not None or any(answer["real_time"] for answer in self._ask({}, sysids)):
            return self._disturb(wanted, sysids)
        with clock.standing(sysids):
            # One that was about to begin a tick when it was held may be one further than it says.
            soonest = 1 + max(answer["tick"] for answer in self._ask({}, sysids))
            return self._disturb(wanted | {"from_tick": soonest}, sysids)

    def _disturb(self, wanted: dict[str, float | None], sysids: Iterable[int]) -> int:
        answers = self._ask({"disturb": wanted}, sysids)
        return max(int(answer["from_tick"]) for answer in answers)

    def _ask(self, request: dict[str, Any], sysids: Iterable[int]) -> Iterable[dict[str, Any]]:
        """The answers of all; raises InputError when some refused or did not answer."""
        answers = self._tell(request, sysids, DISTURB_TIMEOUT_S)
        answers.require_all()
        return answers.of.values()

    def _tell(self, request: dict[str, Any], sysids: Iterable[int], timeout_s: float) -> Answers:
        return ask_swarm(self._session, self._key, request, sysids, timeout_s)
