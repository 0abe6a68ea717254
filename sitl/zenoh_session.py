"""Opening a Zenoh session for a swarm on this machine, and the swarm's keys.

Peers listen on sockets of their own and connect to those that they are told; nobody scouts. In lockstep the leases are
long, since a paused process must lose nothing; one that has ended is noticed at once, by its closed socket. In real
time one that is silent for two seconds has gone, until it is back.
"""

import contextlib
import json
import socket
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import zenoh

from missions.errors import InputError
from sitl.zenoh_tls import Tls, why_refused

UNIX = "unixsock-stream/"
LEASE_MS = 3_600_000
LIVE_LEASE_MS = 2000
"""As long as samples are carried on by default: a shorter silence, of a machine that is busy, changes no graph."""
ROUTER_TIMEOUT_MS = 5000


@dataclass(frozen=True)
class Peer:
    """Where a session listens and connects to, as Zenoh endpoints ("unixsock-stream/path", "tcp/host:port").

    Attributes:
        listen, connect: endpoints.
        mode: of the session; a client has one router to connect to.
        tls: its certificates; None for none.
        access_control: a router's rules; None lets everybody do everything.
    """

    listen: tuple[str, ...]
    connect: tuple[str, ...]
    mode: Literal["peer", "client", "router"] = "peer"
    tls: Tls | None = None
    access_control: dict[str, object] | None = None


def open_session(peer: Peer, *, real_time: bool = False) -> zenoh.Session:
    """Open a session; the caller closes it, best by `with`.

    Args:
        peer: where it listens and connects.
        real_time: whether it goes when it falls silent, and does not hold up others.

    Raises:
        InputError: a client has found no router, or is not let in; the message says which and why.
        zenoh.ZError: it cannot listen there.
    """
    config = zenoh.Config()
    for key, value in (_settings(peer) | _timing(real_time)).items():
        config.insert_json5(key, json.dumps(value))
    try:
        return zenoh.open(config)
    except zenoh.ZError:
        if peer.mode != "client":
            raise
        host, _, port = peer.connect[0].partition("/")[2].rpartition(":")
        raise InputError(f"router {peer.connect[0]}: {why_refused(host, int(port), peer.tls)}") from None


def _settings(peer: Peer) -> dict[str, object]:
    client = peer.mode == "client"
    settings: dict[str, object] = {"mode": peer.mode}
    if peer.tls is not None:
        settings["transport/link/tls"] = peer.tls.settings()
    if peer.access_control is not None:
        settings["access_control"] = peer.access_control
    return settings | {
        "listen/endpoints": list(peer.listen),
        "connect/endpoints": list(peer.connect),
        "connect/timeout_ms": ROUTER_TIMEOUT_MS if client else -1,
        "connect/exit_on_failure": client,
        "connect/retry": {"period_init_ms": 50, "period_max_ms": 200, "period_increase_factor": 1.5},
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "scouting/delay": 0,
        "transport/shared_memory/enabled": False,
    }


def _timing(real_time: bool) -> dict[str, object]:
    if real_time:
        return {"transport/link/tx/lease": LIVE_LEASE_MS}
    return {
        "transport/link/tx/lease": LEASE_MS,
        "transport/link/tx/keep_alive": 400,
        "transport/link/tx/queue/congestion_control/block/wait_before_close": 3_600_000_000,
    }


def correction_key(swarm: str, sysid: int) -> str:
    """Where a vehicle publishes its corrections."""
    return f"skein/{swarm}/{sysid}/correction"


def intent_key(swarm: str, sysid: int) -> str:
    """Where a vehicle publishes its intents."""
    return f"skein/{swarm}/{sysid}/intent"


def losses_key(swarm: str, sysid: int) -> str:
    """Where a vehicle tells whom it misses."""
    return f"skein/{swarm}/{sysid}/losses"


def alive_key(swarm: str, sysid: int | str) -> str:
    """The liveliness token of a vehicle; sysid "*" for all."""
    return f"skein/{swarm}/{sysid}/alive"


def clock_key(swarm: str) -> str:
    """The queryable that holds, releases, paces and stops the clocks."""
    return f"skein/{swarm}/clock"


def network_key(swarm: str) -> str:
    """The queryable that tells how the links stand, and disturbs them."""
    return f"skein/{swarm}/network"


def sysid_of(alive: str, swarm: str) -> int:
    """The sysid in a liveliness token's key."""
    return int(alive.removeprefix(f"skein/{swarm}/").removesuffix("/alive"))


def local_peers(numbers: Iterable[int]) -> tuple[dict[int, Peer], Peer]:
    """A swarm's peers on this machine, one a process.

    All are connected with each other, since who is lost may leave any two as neighbours: each connects to those with
    smaller numbers, the station to all. They meet on Unix sockets in a new folder, or on free TCP ports where there
    are none.

    Args:
        numbers: of the processes.

    Returns:
        The processes' peers by number, and the station's.
    """
    everyone = sorted(numbers)
    address = dict(zip(everyone, _addresses(everyone), strict=True))
    peers = {
        number: Peer((address[number],), tuple(address[other] for other in everyone if other < number))
        for number in everyone
    }
    return peers, Peer((), tuple(address.values()))


def _addresses(numbers: list[int]) -> list[str]:
    if hasattr(socket, "AF_UNIX"):
        folder = tempfile.mkdtemp(prefix="skein-")
        return [f"{UNIX}{folder}/{number}" for number in numbers]
    with contextlib.ExitStack() as stack:
        listeners = [stack.enter_context(socket.create_server(("127.0.0.1", 0))) for _ in numbers]
        return [f"tcp/127.0.0.1:{listener.getsockname()[1]}" for listener in listeners]


def make_socket_folder(peer: Peer) -> None:
    """Make the folder of a session's socket again, if the last that had one in it has removed it."""
    for endpoint in peer.listen:
        if endpoint.startswith(UNIX):
            Path(endpoint.removeprefix(UNIX)).parent.mkdir(mode=0o700, exist_ok=True)


def discard_sockets(peer: Peer) -> None:
    """Remove what a closed session leaves behind: its socket, and the folder if it was the last."""
    for endpoint in peer.listen:
        if endpoint.startswith(UNIX):
            path = Path(endpoint.removeprefix(UNIX))
            for left in (path, path.with_name(path.name + ".lock")):
                left.unlink(missing_ok=True)
            with contextlib.suppress(OSError):
                path.parent.rmdir()
