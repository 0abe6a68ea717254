"""What is true of an endpoint's sockets, on loopback."""

import contextlib
import socket
import time
from collections.abc import Iterator

import pytest

from missions.errors import InputError
from sitl.services.links import MOST_STRANGERS, StationLinks
from sitl.services.peer import Peer
from sitl.services.tcp_client import BACKLOG_BYTES

PATIENCE_S = 5.0


class Recorder:
    """A face that notes what happens to it."""

    def __init__(self) -> None:
        self.present: set[Peer] = set()
        self.received: dict[Peer, bytes] = {}

    def add_peer(self, peer: Peer) -> None:
        self.present.add(peer)

    def remove_peer(self, peer: Peer) -> None:
        self.present.discard(peer)

    def on_bytes(self, data: bytes, peer: Peer) -> None:
        self.present.add(peer)
        self.received[peer] = self.received.get(peer, b"") + data


@pytest.fixture
def station() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.bind(("127.0.0.1", 0))
        udp.settimeout(PATIENCE_S)
        yield udp


@pytest.fixture
def face() -> Recorder:
    return Recorder()


@pytest.fixture
def links(station: socket.socket, face: Recorder) -> Iterator[StationLinks]:
    with contextlib.closing(StationLinks(0, [station.getsockname()])) as links:
        links.attach(face)
        yield links


def connect(links: StationLinks) -> socket.socket:
    return socket.create_connection(("127.0.0.1", links.tcp_port), PATIENCE_S)


def peer_of(client: socket.socket) -> Peer:
    return Peer("tcp", *client.getsockname())


def poll_until(links: StationLinks, condition: object) -> None:
    """Serve until the condition holds; fails when it never does."""
    assert callable(condition)
    limit_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < limit_s
        links.poll(0.1)


def test_configured_stations_are_present_from_the_start(
    links: StationLinks, face: Recorder, station: socket.socket
) -> None:
    (peer,) = face.present
    links.send(peer, b"one datagram")
    assert station.recv(100) == b"one datagram"


def test_whoever_talks_to_the_udp_port_is_answered(links: StationLinks, face: Recorder) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.settimeout(PATIENCE_S)
        other.sendto(b"hello", ("127.0.0.1", links.udp_port))
        poll_until(links, lambda: face.received)
        links.send(Peer("udp", *other.getsockname()), b"answer")
        assert other.recv(100) == b"answer"


def test_several_tcp_clients_come_talk_and_go(links: StationLinks, face: Recorder) -> None:
    with connect(links) as first, connect(links) as second:
        poll_until(links, lambda: {peer_of(first), peer_of(second)} <= face.present)
        first.sendall(b"from the first")
        poll_until(links, lambda: face.received.get(peer_of(first)) == b"from the first")
        links.send(peer_of(second), b"to the second")
        assert second.recv(100) == b"to the second"
        gone = peer_of(first)
        first.close()
        poll_until(links, lambda: gone not in face.present)
        assert peer_of(second) in face.present


def test_a_client_that_does_not_read_is_dropped_and_holds_up_nobody(links: StationLinks, face: Recorder) -> None:
    with connect(links) as slow, connect(links) as quick:
        poll_until(links, lambda: {peer_of(slow), peer_of(quick)} <= face.present)
        piece = b"x" * 65536
        for _ in range(BACKLOG_BYTES // len(piece) + 200):
            links.send(peer_of(slow), piece)
        links.send(peer_of(quick), b"still here")
        assert quick.recv(100) == b"still here"
        poll_until(links, lambda: peer_of(slow) not in face.present)
        assert peer_of(quick) in face.present


def test_a_client_that_reads_late_gets_everything_in_order(links: StationLinks, face: Recorder) -> None:
    got = b""
    sent = b"".join(number.to_bytes(4, "big") for number in range(50_000))
    with connect(links) as client:
        client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
        poll_until(links, lambda: peer_of(client) in face.present)
        for start in range(0, len(sent), 1000):
            links.send(peer_of(client), sent[start : start + 1000])
        client.setblocking(False)
        while len(got) < len(sent):
            links.poll(0.0)
            with contextlib.suppress(BlockingIOError):
                got += client.recv(65536)
    assert got == sent


def test_a_port_in_use_is_named(links: StationLinks) -> None:
    with pytest.raises(InputError, match=rf"^TCP port {links.tcp_port} on 127.0.0.1: .*choose another port$"):
        StationLinks(links.tcp_port)


def test_sending_to_nobody_is_no_error(links: StationLinks) -> None:
    links.send(Peer("tcp", "127.0.0.1", 1), b"lost")
    links.send(Peer("udp", "127.0.0.1", 1), b"lost")
    links.poll(0.0)


def test_a_turn_takes_several_datagrams_but_not_all_there_are(links: StationLinks, face: Recorder) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.bind(("127.0.0.1", 0))
        for _ in range(100):
            sender.sendto(b"x", ("127.0.0.1", links.udp_port))
        peer = Peer("udp", *sender.getsockname())
        links.poll(PATIENCE_S)
        assert 1 < len(face.received[peer]) < 100
        poll_until(links, lambda: len(face.received[peer]) == 100)


def test_no_number_of_source_ports_costs_memory_or_drives_out_who_is_there(
    links: StationLinks, face: Recorder, monkeypatch: pytest.MonkeyPatch
) -> None:
    now_s = 100.0
    monkeypatch.setattr(time, "monotonic", lambda: now_s)
    station = Peer("udp", "10.0.0.1", 14550)
    for number in range(3 * MOST_STRANGERS):
        assert links._has_room_for(station)
        assert links._has_room_for(Peer("udp", "10.0.0.2", number)) == (number < MOST_STRANGERS - 1)
    assert len(links._heard_at_s) == MOST_STRANGERS
    now_s += 4.0
    assert links._has_room_for(Peer("udp", "10.0.0.3", 1))
    assert len(links._heard_at_s) == MOST_STRANGERS


def test_one_connection_too_many_is_closed(links: StationLinks, face: Recorder) -> None:
    with contextlib.ExitStack() as stack:
        clients = [stack.enter_context(connect(links)) for _ in range(MOST_STRANGERS)]
        poll_until(links, lambda: {peer_of(client) for client in clients} <= face.present)
        last = stack.enter_context(connect(links))
        poll_until(links, lambda: links.refused)
        assert last.recv(100) == b""
        assert peer_of(clients[0]) in face.present
