"""What is true of UDP links, on loopback."""

import asyncio
import socket
from typing import Any

from gcs.links import udp
from gcs.links.udp import UdpLink
from sitl.services.peer import Peer

LOOPBACK = "127.0.0.1"


def test_each_peer_of_a_port_is_answered_where_it_came_from(listen: Any) -> None:
    async def main() -> None:
        link = await UdpLink.open()
        listener = listen(link)
        with socket.socket(type=socket.SOCK_DGRAM) as one, socket.socket(type=socket.SOCK_DGRAM) as other:
            for number, sender in enumerate((one, other)):
                sender.settimeout(10.0)
                sender.sendto(b"from %d" % number, (LOOPBACK, link.port))
                peer = Peer("udp", LOOPBACK, sender.getsockname()[1])
                await listener.until(lambda peer=peer: peer in listener.received)
                assert listener.received[peer] == b"from %d" % number
                link.send(b"to %d" % number, peer)
                assert sender.recv(100) == b"to %d" % number
        await link.close()

    asyncio.run(main())


def test_a_burst_longer_than_a_turn_comes_whole_and_in_order(listen: Any) -> None:
    async def main() -> None:
        link = await UdpLink.open()
        listener = listen(link)
        with socket.socket(type=socket.SOCK_DGRAM) as sender:
            sender.connect((LOOPBACK, link.port))
            pieces = [number.to_bytes(4, "big") for number in range(300)]
            for piece in pieces:
                sender.send(piece)
            peer = Peer("udp", *sender.getsockname())
            await listener.until(lambda: len(listener.received.get(peer, b"")) == 4 * len(pieces))
        assert listener.received[peer] == b"".join(pieces)
        await link.close()

    asyncio.run(main())


def test_towards_one_address_it_speaks_first_and_hears_nobody_else(listen: Any) -> None:
    async def main() -> None:
        with socket.socket(type=socket.SOCK_DGRAM) as vehicle, socket.socket(type=socket.SOCK_DGRAM) as stranger:
            vehicle.bind((LOOPBACK, 0))
            vehicle.settimeout(10.0)
            link = await UdpLink.connect("localhost", vehicle.getsockname()[1])
            listener = listen(link)
            (peer,) = link.greeted
            assert peer == Peer("udp", *vehicle.getsockname())
            link.send(b"hello", peer)
            data, address = vehicle.recvfrom(100)
            assert (data, address[1]) == (b"hello", link.port)
            stranger.sendto(b"me too", address)
            vehicle.sendto(b"answer", address)
            await listener.until(lambda: listener.received)
            assert listener.received == {peer: b"answer"}
            await link.close()

    asyncio.run(main())


def test_a_vehicle_that_is_not_there_yet_is_no_error(listen: Any) -> None:
    async def main() -> None:
        with socket.socket(type=socket.SOCK_DGRAM) as vehicle:
            vehicle.bind((LOOPBACK, 0))
            address = vehicle.getsockname()
        link = await UdpLink.connect(*address)
        listener = listen(link)
        for _ in range(3):
            link.send(b"anyone?", link.greeted[0])
        with socket.socket(type=socket.SOCK_DGRAM) as vehicle:
            vehicle.bind(address)
            vehicle.sendto(b"here", (LOOPBACK, link.port))
            await listener.until(lambda: listener.received)
        await link.close()

    asyncio.run(main())


def test_dense_traffic_is_looked_for_now_and_then_until_it_is_quiet(listen: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr(udp, "_DENSE", 3)
    monkeypatch.setattr(udp, "_WINDOW_S", 0.0)

    async def main() -> None:
        link = await UdpLink.open()
        listener = listen(link)
        with socket.socket(type=socket.SOCK_DGRAM) as sender:
            sender.connect((LOOPBACK, link.port))
            peer = Peer("udp", *sender.getsockname())
            for turn in range(1, 4):
                for _ in range(20):
                    sender.send(b"x")
                await listener.until(lambda turn=turn: listener.received.get(peer) == b"x" * 20 * turn)
                assert link._look is not None
            async with asyncio.timeout(10.0):
                while link._look is not None:
                    await asyncio.sleep(0)
            sender.send(b"y")
            await listener.until(lambda: listener.received[peer].endswith(b"y"))
        await link.close()

    asyncio.run(main())
