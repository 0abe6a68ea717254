"""Holding, releasing, pacing and stopping a swarm's clocks over Zenoh (the queryable `skein/<swarm>/clock`)."""

import contextlib
import logging
import queue
import time
from collections.abc import Iterable, Iterator

import zenoh

from gcs.swarm_query import Answers, ask_swarm
from missions.errors import InputError
from sitl.zenoh_session import alive_key, clock_key, sysid_of

_log = logging.getLogger(__name__)

TIMEOUT_S = 5.0
START_IN_S = 0.5
"""Time for the word of the start to reach every vehicle."""


class SwarmClock:
    """The clocks of a swarm, as one.

    Args:
        session: told to connect to all endpoints.
        swarm: the swarm's name.
        sysids: of the vehicles; their liveliness tokens are waited for, since an endpoint declares its clock before.
        patience_s: to wait for each of them; None for as long as vehicles on one machine take.

    Raises:
        InputError: some of them cannot be reached.
    """

    def __init__(
        self, session: zenoh.Session, swarm: str, sysids: Iterable[int], patience_s: float | None = None
    ) -> None:
        self._session = session
        self._key = clock_key(swarm)
        missing = set(sysids)
        tokens: queue.SimpleQueue[zenoh.Sample] = queue.SimpleQueue()
        subscriber = session.liveliness().declare_subscriber(
            alive_key(swarm, "*"), zenoh.handlers.Callback(tokens.put, indirect=False), history=True
        )
        try:
            while missing:
                missing.discard(sysid_of(str(tokens.get(timeout=patience_s or TIMEOUT_S).key_expr), swarm))
        except queue.Empty:
            raise InputError(f"vehicles {sorted(missing)} cannot be reached over Zenoh") from None
        finally:
            subscriber.undeclare()
        _log.info("Zenoh: the clocks of swarm %s are there", swarm)

    def release(self, sysids: Iterable[int]) -> None:
        """Let the clocks of these vehicles go on.

        Raises:
            InputError: some of them did not answer, or refused.
        """
        self._ask({"do": "release"}, sysids)

    def start(self, sysids: Iterable[int], at_s: float | None = None) -> None:
        """Release the clocks of these vehicles so that their next tick begins at one moment. Raises as `release`.

        Args:
            sysids: of the vehicles.
            at_s: UNIX time, by the clocks of all their machines; None for soon.
        """
        self._ask({"do": "release", "at": time.time() + START_IN_S if at_s is None else at_s}, sysids)

    def hold(self, sysids: Iterable[int]) -> None:
        """Let the clocks of these vehicles stand still. Raises as `release`."""
        self._ask({"do": "hold"}, sysids)

    @contextlib.contextmanager
    def standing(self, sysids: Iterable[int]) -> Iterator[None]:
        """Within this context the clocks of these vehicles stand still; afterwards they go on, unless all stood still
        before. Raises as `release`."""
        told = self._tell({"do": "hold"}, sysids)
        try:
            told.require_all()
            yield
        finally:
            if not all(answer["was_held"] for answer in told.of.values()):
                self.release(sysids)

    def pace(self, speed: float, sysids: Iterable[int]) -> None:
        """Set the speed factor; 0 for as fast as it goes. Raises as `release`."""
        self._ask({"speed": speed}, sysids)

    def stop(self, sysids: Iterable[int]) -> None:
        """End the simulation of these vehicles. Raises as `release`."""
        self._ask({"do": "stop"}, sysids)

    def _ask(self, request: dict[str, object], sysids: Iterable[int]) -> None:
        self._tell(request, sysids).require_all()

    def _tell(self, request: dict[str, object], sysids: Iterable[int]) -> Answers:
        return ask_swarm(self._session, self._key, request, sysids, TIMEOUT_S)
