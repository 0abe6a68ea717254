"""Other people's stations, and endpoints' faces for them to talk to."""

import contextlib
import selectors
import socket
import threading
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.bench.mavproxy_station import MavProxy
from gcs.bench.mavsdk_station import MavsdkStation, plugin
from gcs.bench.peers import LOOPBACK
from missions.autopilot import Autopilot
from sitl.services.codec import Codec

HEARTBEAT_S = 0.2
MakeMavsdk = Callable[[str], MavsdkStation]
MakeMavProxy = Callable[[str], MavProxy]
MakeRelay = Callable[..., "LossyRelay"]
MakeMissions = Callable[[Autopilot], Any]


@pytest.fixture
def mavsdk() -> Iterator[MakeMavsdk]:
    """MAVSDK instances, by what they connect to."""
    with contextlib.ExitStack() as stack:
        yield lambda url: stack.enter_context(MavsdkStation(url))


@pytest.fixture
def mavproxy(tmp_path: Path) -> Iterator[MakeMavProxy]:
    """MAVProxy processes at home in `tmp_path`, by what they connect to."""
    with contextlib.ExitStack() as stack:
        yield lambda master: stack.enter_context(MavProxy(master, tmp_path))


class LossyRelay:
    """Carries datagrams between one station and one endpoint, and drops those of both ways that it is told to.

    The station talks to `port`; what it says leaves for the endpoint from another socket.
    """

    def __init__(self, endpoint_port: int, lost: Callable[[bytes], bool]) -> None:
        self._lost = lost
        self._near = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._near.bind((LOOPBACK, 0))
        self._far = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._far.connect((LOOPBACK, endpoint_port))
        self._wake, self._stop = socket.socketpair()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()
        self.port = int(self._near.getsockname()[1])
        self.n_dropped = 0

    def close(self) -> None:
        """Stop carrying, and close the sockets."""
        self._stop.send(b"\0")
        self._thread.join()
        for end in (self._near, self._far, self._wake, self._stop):
            end.close()

    def _run(self) -> None:
        station = None
        with selectors.DefaultSelector() as selector:
            for end in (self._near, self._far, self._wake):
                selector.register(end, selectors.EVENT_READ)
            while True:
                for key, _ in selector.select():
                    if key.fileobj is self._wake:
                        return
                    with contextlib.suppress(ConnectionRefusedError):
                        if key.fileobj is self._near:
                            data, station = self._near.recvfrom(65536)
                            if self._survives(data):
                                self._far.send(data)
                        else:
                            data = self._far.recv(65536)
                            if station is not None and self._survives(data):
                                self._near.sendto(data, station)

    def _survives(self, data: bytes) -> bool:
        lost = self._lost(data)
        self.n_dropped += lost
        return not lost


@pytest.fixture
def relay() -> Iterator[MakeRelay]:
    """Lossy relays to an endpoint's UDP port; told what is lost of each datagram's bytes."""
    with contextlib.ExitStack() as stack:

        def make(endpoint_port: int, lost: Callable[[bytes], bool]) -> LossyRelay:
            return stack.enter_context(contextlib.closing(LossyRelay(endpoint_port, lost)))

        yield make


class HeartbeatSource:
    """A plane of an autopilot that does nothing but send heartbeats, to whoever connects."""

    def __init__(self, autopilot: Autopilot) -> None:
        self._server = socket.create_server((LOOPBACK, 0))
        self.port = int(self._server.getsockname()[1])
        self._stopped = threading.Event()
        self._heartbeat = mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_FIXED_WING, autopilot.mav_autopilot, 0, 0, mavlink.MAV_STATE_STANDBY, 3
        )
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._stopped.set()
        self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()
        self._thread.join()

    def _run(self) -> None:
        codec = Codec(1, 1)
        with contextlib.suppress(OSError):
            connection, _ = self._server.accept()
            with connection:
                while not self._stopped.wait(HEARTBEAT_S):
                    connection.sendall(codec.pack(self._heartbeat))


@pytest.fixture(scope="module")
def raw_missions() -> Iterator[MakeMissions]:
    """MAVSDK's raw missions of a plane, by its autopilot: one station for each that is asked for."""
    with contextlib.ExitStack() as stack:

        @cache
        def make(autopilot: Autopilot) -> Any:
            source = stack.enter_context(contextlib.closing(HeartbeatSource(autopilot)))
            station = stack.enter_context(MavsdkStation(f"tcpout://{LOOPBACK}:{source.port}"))
            return plugin("mission_raw", station.wait_for([1])[0])

        yield make
