"""Holding, releasing, pacing and stopping a swarm's clocks over Zenoh (the queryable `skein/<swarm>/clock`)."""

import json
import logging
import queue
import time
from collections.abc import Iterable

import zenoh

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

    def pace(self, speed: float, sysids: Iterable[int]) -> None:
        """Set the speed factor; 0 for as fast as it goes. Raises as `release`."""
        self._ask({"speed": speed}, sysids)

    def stop(self, sysids: Iterable[int]) -> None:
        """End the simulation of these vehicles. Raises as `release`."""
        self._ask({"do": "stop"}, sysids)

    def _ask(self, request: dict[str, object], sysids: Iterable[int]) -> None:
        waiting = set(sysids)
        replies = self._session.get(
            self._key,
            payload=json.dumps(request),
            target=zenoh.QueryTarget.ALL,
            consolidation=zenoh.ConsolidationMode.NONE,
            timeout=TIMEOUT_S,
        )
        for reply in replies:
            if reply.ok is not None:
                waiting.discard(json.loads(reply.ok.payload.to_bytes())["sysid"])
            elif reply.err is not None:
                raise InputError(reply.err.payload.to_bytes().decode("utf-8", "replace"))
            if not waiting:
                return
        if waiting:
            raise InputError(f"the clocks of vehicles {sorted(waiting)} did not answer within {TIMEOUT_S:g} s")
