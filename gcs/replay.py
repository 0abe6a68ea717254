"""Playing telemetry logs back to a station, as if the vehicles were there."""

import asyncio
import heapq
import time
from collections.abc import Awaitable, Callable, Sequence
from pathlib import Path

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.links.link import Link
from gcs.tlog_reader import Logged, read_tlog
from missions.errors import InputError
from sitl.services.peer import Peer

_LARGEST_PIECE = 1400
"""Bytes sent at once: a datagram that no network cuts up."""

Sleep = Callable[[float], Awaitable[None]]


def read_replay(paths: Sequence[Path]) -> list[Logged]:
    """What the vehicles in some logs said, in the order of time.

    What stations said is left out, and so are keys, which are for one vehicle only.

    Raises:
        InputError: a file cannot be read, or no vehicle is in it.
    """
    logs = []
    for path in paths:
        messages = list(read_tlog(path))
        stations = {one.message.get_srcSystem() for one in messages if _is_stations(one)}
        said = [one for one in messages if one.message.get_srcSystem() not in stations and not _is_key(one)]
        if not said:
            raise InputError(f"{path}: no vehicle in it, only stations")
        logs.append(said)
    return list(heapq.merge(*logs, key=lambda one: one.time_s))


async def replay(
    messages: Sequence[Logged],
    link: Link,
    speed: float,
    now: Callable[[], float] = time.monotonic,
    sleep: Sleep = asyncio.sleep,
    told: Callable[[float], None] = lambda _: None,
) -> int:
    """Play messages back over a link, at the pace of their stamps; on a link that listens, once somebody is there.

    Args:
        messages: in the order of time.
        link: not attached to anything.
        speed: logged seconds a second, more than 0.
        now, sleep: the time in seconds, and a way to let some of it pass.
        told: called with how many logged seconds have been played.

    Returns:
        The number of frames sent.
    """
    peers = await _peers(link)
    pieces = _pieces(messages)
    began_s, first_s = now(), messages[0].time_s
    for time_s, piece in pieces:
        wait_s = (time_s - first_s) / speed - (now() - began_s)
        if wait_s > 0.0:
            await sleep(wait_s)
        for peer in (*link.greeted, *peers):
            link.send(piece, peer)
        told(time_s - first_s)
    return len(messages)


async def _peers(link: Link) -> set[Peer]:
    """Those that send something to a link that has nobody to send to by itself, from the first one on."""
    peers: set[Peer] = set()
    somebody = asyncio.Event()

    def on_bytes(data: bytes, peer: Peer) -> None:
        if peer not in link.greeted:
            peers.add(peer)
        somebody.set()

    link.on_bytes = on_bytes
    link.on_back = lambda peer: somebody.set()
    if not link.greeted:
        await somebody.wait()
    return peers


def _pieces(messages: Sequence[Logged]) -> list[tuple[float, bytes]]:
    """Frames with one stamp put together, as they were sent."""
    pieces: list[tuple[float, bytes]] = []
    for time_s, message in messages:
        frame = message.get_msgbuf()
        if pieces and pieces[-1][0] == time_s and len(pieces[-1][1]) + len(frame) <= _LARGEST_PIECE:
            pieces[-1] = (time_s, pieces[-1][1] + frame)
        else:
            pieces.append((time_s, frame))
    return pieces


def _is_stations(one: Logged) -> bool:
    return bool(one.message.get_type() == "HEARTBEAT" and one.message.type == mavlink.MAV_TYPE_GCS)


def _is_key(one: Logged) -> bool:
    kind: str = one.message.get_type()
    return kind == "SETUP_SIGNING"
