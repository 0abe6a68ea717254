"""A browser in the place of a browser: it takes a console's page at the WebSocket, and counts what comes.

A frame is viser's: two lengths of 8 bytes, a message pack compressed by zstd, and the arrays that it refers to, each
from a multiple of 8 bytes on.
"""

import itertools
import time
from collections.abc import Iterator
from multiprocessing.connection import Connection
from typing import Any

import msgspec
import numpy as np
import numpy.typing as npt
import viser
import zstandard
from viser._messages import ViewerCameraMessage
from websockets.sync.client import connect
from websockets.sync.connection import Connection as Socket

AIRCRAFT = "/swarm/aircraft"
_LENGTHS = 16
_ALIGNMENT = 8
_PATIENCE_S = 60.0


def view(port: int, pipe: Connection) -> None:
    """Look at a page of this machine. Tells through the pipe that aircraft are seen; counts from the first word that
    comes through it to the next, and tells (frames, poses, bytes, seconds)."""
    version = f"viser-v{viser.__version__}"
    with connect(f"ws://127.0.0.1:{port}/", subprotocols=[version], max_size=None) as socket:  # type: ignore[list-item]
        socket.send(camera())
        _until_seen(socket)
        pipe.send(None)
        while not pipe.poll():
            _receive(socket)
        pipe.recv()
        frames = poses = size = 0
        began_s = time.monotonic()
        while not pipe.poll():
            data = _receive(socket)
            size += len(data)
            for places in aircraft_in(data):
                frames += 1
                poses += len(places)
        pipe.send((frames, poses, size, time.monotonic() - began_s))


def aircraft_in(data: bytes) -> Iterator[npt.NDArray[np.float32]]:
    """Where each message in a frame places the aircraft, (n, 3) in units of the scene."""
    packed = int.from_bytes(data[8:16], "little")
    content: dict[str, Any] = msgspec.msgpack.decode(zstandard.decompress(data[_LENGTHS : _LENGTHS + packed]))
    for message in content["messages"]:
        placed = message.get("updates", {}).get("batched_positions") if message.get("name") == AIRCRAFT else None
        if placed is not None:
            sizes = content["binaryBufferLengths"]
            begins = itertools.accumulate(
                sizes, lambda at, size: _aligned(at + size), initial=_aligned(_LENGTHS + packed)
            )
            begin, size = list(begins)[placed["__binary_index"]], sizes[placed["__binary_index"]]
            yield np.frombuffer(data[begin : begin + size], dtype=np.float32).reshape(-1, 3)


def _aligned(at: int) -> int:
    return -(-at // _ALIGNMENT) * _ALIGNMENT


def _until_seen(socket: Socket) -> None:
    deadline_s = time.monotonic() + _PATIENCE_S
    while not any(map(len, aircraft_in(_receive(socket)))):
        if time.monotonic() > deadline_s:
            raise TimeoutError("no aircraft on the page")


def _receive(socket: Socket) -> bytes:
    data = socket.recv(_PATIENCE_S)
    assert isinstance(data, bytes)
    return data


def camera() -> bytes:
    """What a browser says first: from where it looks."""
    camera = ViewerCameraMessage(
        wxyz=(1.0, 0.0, 0.0, 0.0),
        position=(0.0, -5.0, 5.0),
        fov=1.0,
        near=0.01,
        far=1000.0,
        image_height=900,
        image_width=1440,
        look_at=(0.0, 0.0, 0.0),
        up_direction=(0.0, 0.0, 1.0),
    )
    return msgspec.msgpack.encode(camera.as_serializable_dict())
