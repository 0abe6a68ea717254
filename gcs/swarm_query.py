"""Asking all vehicles of a swarm something over Zenoh."""

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import zenoh

from missions.errors import InputError

_TIMEOUT = b"Timeout"
"""What Zenoh itself says in the name of those that did not answer in time."""


@dataclass(frozen=True)
class Answers:
    """What a swarm has answered.

    Attributes:
        of: by sysid, of those who were asked for.
        refusals: what processes that refused have said.
        silent: who has not answered.
        timeout_s: so long they had.
    """

    of: dict[int, dict[str, Any]]
    refusals: tuple[str, ...]
    silent: tuple[int, ...]
    timeout_s: float

    def require_all(self) -> None:
        """Raises InputError when some refused or did not answer."""
        if self.refusals:
            raise InputError(self.refusals[0])
        if self.silent:
            raise InputError(f"vehicles {list(self.silent)} did not answer within {self.timeout_s:g} s")


def ask_swarm(
    session: zenoh.Session, key: str, request: dict[str, Any], sysids: Iterable[int], timeout_s: float
) -> Answers:
    """Ask all vehicles; returns as soon as all that are waited for have answered, or who has not is gone.

    Args:
        session: told to connect to all endpoints.
        key: of the queryable that each process has.
        request: becomes JSON.
        sysids: who is waited for.
        timeout_s: to wait.
    """
    wanted, of, refusals = set(sysids), dict[int, dict[str, Any]](), list[str]()
    replies = session.get(
        key,
        payload=json.dumps(request),
        target=zenoh.QueryTarget.ALL,
        consolidation=zenoh.ConsolidationMode.NONE,
        timeout=timeout_s,
    )
    for reply in replies:
        if reply.ok is not None:
            answer = json.loads(reply.ok.payload.to_bytes())
            of[answer["sysid"]] = answer
        elif reply.err is not None and (why := reply.err.payload.to_bytes()) != _TIMEOUT:
            refusals.append(why.decode("utf-8", "replace"))
        if wanted <= of.keys():
            break
    answered = {sysid: answer for sysid, answer in of.items() if sysid in wanted}
    return Answers(answered, tuple(refusals), tuple(sorted(wanted - of.keys())), timeout_s)
