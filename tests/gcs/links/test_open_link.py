"""Links by URL: each kind, and what is said of the rest."""

import asyncio
import socket

import pytest

from gcs.links.open_link import open_link
from gcs.links.tcp import TcpLink
from gcs.links.tcp_server import TcpServerLink
from gcs.links.udp import UdpLink
from missions.errors import InputError
from sitl.services.peer import Peer


def test_each_kind_of_link() -> None:
    async def main() -> None:
        for url in ("udpin://127.0.0.1:0", "udpin://:0", "udp://:0"):
            listening = await open_link(url)
            assert isinstance(listening, UdpLink)
            assert listening._socket.getsockname()[0] == "127.0.0.1"
            await listening.close()
        sending = await open_link("udpout://127.0.0.1:9")
        assert isinstance(sending, UdpLink)
        assert sending.greeted == (Peer("udp", "127.0.0.1", 9),)
        await sending.close()
        server = await open_link("tcpin://:0")
        assert isinstance(server, TcpServerLink)
        for scheme in ("tcp", "tcpout"):
            client = await open_link(f"{scheme}://127.0.0.1:{server.port}")
            assert isinstance(client, TcpLink)
            await client.close()
        await server.close()

    asyncio.run(main())


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("14550", "unknown kind of link; accepted are udpin"),
        ("http://127.0.0.1:80", "unknown kind of link; accepted are udpin"),
        ("udpin://127.0.0.1", "no port of 0 to 65535"),
        ("udpin://127.0.0.1:70000", "no port of 0 to 65535"),
        ("udpin://127.0.0.1:x", "no port of 0 to 65535"),
        ("udpin://[::1", "Invalid IPv6"),
        ("udpout://:14550", "no host to send to"),
        ("udpout://127.0.0.1:0", "no port of 1 to 65535"),
        ("tcp:127.0.0.1:5760", "no host to send to"),
        ("tcp://127.0.0.1:1", "check the address"),
        ("serial:///dev/ttyUSB0", "as in serial:///dev/ttyUSB0:57600"),
        ("serial://ttyUSB0:57600", "as in serial:///dev/ttyUSB0:57600"),
    ],
)
def test_other_urls_are_told_what_is_accepted(url: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        asyncio.run(open_link(url))


def test_a_host_that_does_not_exist_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(*_: object, **__: object) -> None:
        raise socket.gaierror(-2, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    with pytest.raises(InputError, match="udp nowhere:14550: Name or service not known; check the address"):
        asyncio.run(open_link("udpout://nowhere:14550"))
