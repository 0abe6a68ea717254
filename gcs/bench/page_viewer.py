"""A browser in the place of a browser: it takes a console's page at the WebSocket, and counts what comes.

A frame is viser's: two lengths of 8 bytes, a message pack compressed by zstd, and the arrays that it refers to, each
from a multiple of 8 bytes on.
"""

import time
from collections.abc import Iterator
from multiprocessing.connection import Connection
from typing import Any

import msgspec
import viser
import zstandard
from viser._messages import ViewerCameraMessage
from websockets.sync.client import connect
from websockets.sync.connection import Connection as Socket

AIRCRAFT = "/swarm/aircraft"
POSITION_BYTES = 12
_LENGTHS = 16
_PATIENCE_S = 60.0


def view(port: int, pipe: Connection) -> None:
    """Look at a page of this machine. Tells through the pipe that aircraft are seen; counts from the first word that
    comes through it to the next, and tells (frames, poses, bytes, seconds)."""
    version = f"viser-v{viser.__version__}"
    with connect(f"ws://127.0.0.1:{port}/", subprotocols=[version], max_size=None) as socket:  # type: ignore[list-item]
        socket.send(_camera())
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
            for count in aircraft_in(data):
                frames += 1
                poses += count
        pipe.send((frames, poses, size, time.monotonic() - began_s))


def aircraft_in(data: bytes) -> Iterator[int]:
    """How many aircraft each message in a frame places."""
    packed = int.from_bytes(data[8:16], "little")
    content: dict[str, Any] = msgspec.msgpack.decode(zstandard.decompress(data[_LENGTHS : _LENGTHS + packed]))
    for message in content["messages"]:
        placed = message.get("updates", {}).get("batched_positions") if message.get("name") == AIRCRAFT else None
        if placed is not None:
            yield content["binaryBufferLengths"][placed["__binary_index"]] // POSITION_BYTES


def _until_seen(socket: Socket) -> None:
    deadline_s = time.monotonic() + _PATIENCE_S
    while not any(aircraft_in(_receive(socket))):
        if time.monotonic() > deadline_s:
            raise TimeoutError("no aircraft on the page")


def _receive(socket: Socket) -> bytes:
    data = socket.recv(_PATIENCE_S)
    assert isinstance(data, bytes)
    return data


def _camera() -> bytes:
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
