"""The links of a process's vehicles, to be seen and disturbed from the station (docs/formation.md, While it flies)."""

import json
import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import asdict
from typing import Any

import zenoh

from sitl.endpoint import Endpoint
from sitl.ticks import TICK_S
from sitl.zenoh_session import network_key

DELAY_MAX_S = 60.0
_KEYS = {"delay_s", "loss", "from_tick"}


def serve_network(session: zenoh.Session, swarm: str, endpoints: Callable[[], Mapping[int, Endpoint]]) -> None:
    """Answer queries on the swarm's network key with the state of each vehicle, or an error that says what was wrong.

    A query's payload is JSON: {} or nothing for the state, and {"disturb": {"delay_s": 0 to 60, rounded up to whole
    ticks, "loss": 0 to 1, "from_tick": a tick that the vehicle has not begun, or null for its next}}. An answer has
    sysid, tick (the next), real_time, links (a `LinkState` each) and the disturbance in force; to a request to disturb
    also from_tick, the tick from which that counts.

    Args:
        session: open.
        swarm: part of the key.
        endpoints: gives the vehicles of this process, by sysid; asked from Zenoh's threads.
    """
    key = network_key(swarm)

    def answer(query: zenoh.Query) -> None:
        flying = endpoints()
        try:
            wanted = _wanted(json.loads(query.payload.to_bytes())) if query.payload is not None else None
        except (ValueError, RecursionError) as error:
            query.reply_err(f"vehicle {', '.join(map(str, flying))}: {error}")
            return
        for sysid, endpoint in flying.items():
            try:
                told = {} if wanted is None else {"from_tick": endpoint.disturb(*wanted)}
            except ValueError as error:
                query.reply_err(f"vehicle {sysid}: disturb.{error}")
                continue
            query.reply(key, json.dumps(_state(endpoint) | told))

    session.declare_queryable(key, zenoh.handlers.Callback(answer, indirect=False))


def _state(endpoint: Endpoint) -> dict[str, object]:
    tick, disturbance, links = endpoint.network_state()
    return {
        "sysid": endpoint.sysid,
        "tick": tick,
        "real_time": endpoint.real_time,
        "links": [asdict(link) for link in links],
        "disturbance": {
            "delay_s": disturbance.delay_ticks * TICK_S,
            "loss": disturbance.loss,
            "from_tick": disturbance.from_tick,
        },
    }


def _wanted(request: Any) -> tuple[int, float, int | None] | None:
    """The delay in ticks, the loss and the tick that are asked for; None when it is the state only."""
    _check_keys("the request", request, {"disturb"})
    if "disturb" not in request:
        return None
    disturb = request["disturb"]
    _check_keys("disturb", disturb, _KEYS)
    delay_s = _number(disturb, "delay_s", DELAY_MAX_S)
    loss = _number(disturb, "loss", 1.0)
    from_tick = disturb.get("from_tick")
    if from_tick is not None and (type(from_tick) is not int or from_tick < 0):
        raise ValueError("disturb.from_tick: not a tick: a whole number, 0 or more, or null")
    return math.ceil(delay_s / TICK_S - 1e-9), loss, from_tick


def _check_keys(name: str, value: Any, keys: Collection[str]) -> None:
    if not isinstance(value, dict):
        raise ValueError(f"{name}: not a JSON object")
    if unknown := value.keys() - keys:
        raise ValueError(f"{name}: no key {min(unknown)!r}; there are {', '.join(sorted(keys))}")


def _number(disturb: dict[str, Any], key: str, most: float) -> float:
    value = disturb.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value <= most:
        raise ValueError(f"disturb.{key}: must be a number from 0 to {most:g}")
    return float(value)
