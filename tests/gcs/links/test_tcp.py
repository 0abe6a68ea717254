"""What is true of TCP links, on loopback."""

import asyncio
import socket
from typing import Any

import pytest

from gcs.links.tcp import BACKLOG_BYTES, TcpLink
from gcs.links.tcp_server import TcpServerLink
from missions.errors import InputError
from sitl.services.peer import Peer

LOOPBACK = "127.0.0.1"


async def accept(listener: socket.socket) -> socket.socket:
    connection, _ = await asyncio.get_running_loop().sock_accept(listener)
    return connection


def listening(port: int = 0) -> socket.socket:
    listener = socket.create_server((LOOPBACK, port))
    listener.setblocking(False)
    return listener


def test_a_lost_connection_is_told_and_made_again(listen: Any) -> None:
    async def main() -> None:
        loop = asyncio.get_running_loop()
        with listening() as listener:
            link = await TcpLink.connect(*listener.getsockname())
            heard = listen(link)
            with await accept(listener) as vehicle:
                await loop.sock_sendall(vehicle, b"one")
                await heard.until(lambda: heard.received.get(link.peer) == b"one")
            port = listener.getsockname()[1]
        await heard.until(lambda: heard.news == [("lost", link.peer)])
        link.send(b"into the void", link.peer)
        with listening(port) as listener, await accept(listener) as vehicle:
            await heard.until(lambda: ("back", link.peer) in heard.news)
            await loop.sock_sendall(vehicle, b"two")
            await heard.until(lambda: heard.received[link.peer] == b"onetwo")
            link.send(b"three", link.peer)
            assert await loop.sock_recv(vehicle, 100) == b"three"
            await link.close()
            assert await loop.sock_recv(vehicle, 100) == b""
        assert [kind for kind, _ in heard.news] == ["lost", "back"]

    asyncio.run(main())


def test_a_link_may_be_closed_while_it_tries_to_come_back(listen: Any) -> None:
    async def main() -> None:
        with listening() as listener:
            link = await TcpLink.connect(*listener.getsockname())
            heard = listen(link)
            (await accept(listener)).close()
        await heard.until(lambda: heard.news)
        await link.close()
        assert asyncio.all_tasks() == {asyncio.current_task()}

    asyncio.run(main())


def test_who_does_not_read_costs_no_memory() -> None:
    async def main() -> None:
        with listening() as listener:
            link = await TcpLink.connect(*listener.getsockname())
            with await accept(listener):
                for _ in range(1000):
                    link.send(bytes(65536), link.peer)
                assert link._transport is not None
                assert link._transport.get_write_buffer_size() < BACKLOG_BYTES + 65536
                await link.close()

    asyncio.run(main())


def test_vehicles_may_connect_to_the_station(listen: Any) -> None:
    async def main() -> None:
        loop = asyncio.get_running_loop()
        link = await TcpServerLink.open()
        heard = listen(link)
        with socket.socket() as one, socket.socket() as other:
            for vehicle in (one, other):
                vehicle.setblocking(False)
                await loop.sock_connect(vehicle, (LOOPBACK, link.port))
                await loop.sock_sendall(vehicle, b"hello")
            peers = [Peer("tcp", *vehicle.getsockname()) for vehicle in (one, other)]
            await heard.until(lambda: set(heard.received) == set(peers))
            assert set(link.greeted) == set(peers)
            link.send(b"to the other", peers[1])
            assert await loop.sock_recv(other, 100) == b"to the other"
            one.close()
            await heard.until(lambda: ("lost", peers[0]) in heard.news)
            assert link.greeted == (peers[1],)
            link.send(b"to the one that has gone", peers[0])
            await link.close()
            assert await loop.sock_recv(other, 100) == b""

    asyncio.run(main())


def test_a_port_in_use_is_named() -> None:
    async def main() -> None:
        link = await TcpServerLink.open()
        with pytest.raises(InputError, match=f"TCP port {link.port} on 127.0.0.1: .*choose another port"):
            await TcpServerLink.open(link.port)
        await link.close()

    asyncio.run(main())
