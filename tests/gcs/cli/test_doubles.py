"""Two vehicles with one system id on one UDP port, of which one is heard a little after the other."""

import asyncio
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import closing
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.cli.station import StationOptions, results_of
from gcs.transfers.errors import TransferError
from sitl.services.codec import Codec

SYSID = 5
APART_S = 0.1


class Doubles:
    """Two sockets that send the heartbeats of one system id to a port in turn, and note what comes to them."""

    def __init__(self, port: int) -> None:
        self.url = f"udpin://127.0.0.1:{port}"
        self.told: set[str] = set()
        self._stop = threading.Event()
        self._sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
        for one in self._sockets:
            one.bind(("127.0.0.1", 0))
            one.connect(("127.0.0.1", port))
            one.setblocking(False)
        self.addresses = ["{}:{}".format(*one.getsockname()) for one in self._sockets]
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._stop.set()
        self._thread.join()
        for one in self._sockets:
            one.close()

    def _run(self) -> None:
        heartbeat = mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_FIXED_WING, 3, 81, 0, 3, 3)
        codec, reader = Codec(SYSID, 1), Codec(0, 0)
        turn = 0
        while not self._stop.wait(APART_S):
            for one in self._sockets:
                try:
                    self.told |= {message.get_type() for message in reader.feed(one.recv(65536))}
                except OSError:  # nothing there, or nobody yet who hears
                    continue
            try:
                self._sockets[turn % 2].send(codec.pack(heartbeat))
            except ConnectionRefusedError:
                continue
            turn += 1


@pytest.fixture
def doubles(free_port: Callable[[], int]) -> Iterator[Doubles]:
    with closing(Doubles(free_port())) as doubles:
        yield doubles


@pytest.mark.parametrize("order", [("mode", "auto"), ("params", "set", "RTL_ALTITUDE", "120"), ("clear", "all")])
def test_neither_of_two_is_told_anything_before_the_other_has_been_heard(
    order: tuple[str, ...], doubles: Doubles, skein: Any
) -> None:
    result = skein(*order, "--vehicle", SYSID, "--connect", doubles.url)
    assert result.exit_code == 2, result.output
    assert f"system id {SYSID} is used by" in result.stderr
    assert all(address in result.stderr for address in doubles.addresses)
    assert doubles.told <= {"HEARTBEAT"}


async def succeeds(vehicle: Any) -> str:
    return "done"


async def fails(vehicle: Any) -> str:
    raise TransferError("not flying")


@pytest.mark.parametrize(("work", "came"), [(succeeds, ""), (fails, "not flying; ")])
def test_who_reached_one_of_two_at_once_hears_of_the_other_all_the_same(work: Any, came: str, doubles: Doubles) -> None:
    options = StationOptions([doubles.url], str(SYSID), None, None, json=True)
    error = asyncio.run(results_of(options, [SYSID], work, whoever=True))[SYSID]
    assert isinstance(error, TransferError)
    assert str(error).startswith(f"{came}system id {SYSID} is used by")
    assert all(address in str(error) for address in doubles.addresses)
