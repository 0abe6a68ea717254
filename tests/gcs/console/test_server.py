"""Where a console is served."""

import socket
from collections.abc import Callable

import pytest
import viser

from gcs.console.server import close_server, open_server
from missions.errors import InputError

LOOPBACK = "127.0.0.1"


@pytest.mark.parametrize("host", ["192.0.2.1", "no.such.host.invalid"])
def test_an_address_of_another_machine_is_refused_at_once(host: str) -> None:
    with pytest.raises(InputError, match=f"--host {host}.*name an address of this machine"):
        open_server(host, 0, None)


def test_a_port_that_is_taken_leads_to_the_next(
    serve_pages: Callable[..., viser.ViserServer], free_port: Callable[[], int]
) -> None:
    port = free_port()
    with socket.create_server((LOOPBACK, port)):
        found = serve_pages(port=port).get_port()
        assert port < found < port + 1000


def test_after_the_last_port_there_is_no_other(monkeypatch: pytest.MonkeyPatch, free_port: Callable[[], int]) -> None:
    port = free_port()
    monkeypatch.setattr("gcs.console.server.LAST_PORT", port)
    with socket.create_server((LOOPBACK, port)), pytest.raises(InputError, match=f"--port {port}: taken"):
        open_server(LOOPBACK, port, None)


def test_two_consoles_on_one_port_are_two(serve_pages: Callable[..., viser.ViserServer]) -> None:
    first = serve_pages()
    second = serve_pages(port=first.get_port())
    assert first.get_port() != second.get_port()


def test_it_listens_on_its_own_address_alone(serve_pages: Callable[..., viser.ViserServer]) -> None:
    port = serve_pages().get_port()
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", port), timeout=10.0)


def test_once_closed_nobody_listens_and_nothing_was_printed(capfd: pytest.CaptureFixture[str]) -> None:
    server = open_server(LOOPBACK, 0, None)
    port = server.get_port()
    close_server(server)
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection((LOOPBACK, port), timeout=10.0)
    assert capfd.readouterr() == ("", "")


def test_a_server_that_gets_no_door_is_not_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    """As with a viser that serves in another way."""

    class Bare:
        def __init__(self, **options: object) -> None:
            self.stopped = False

        def stop(self) -> None:
            stopped.append(self)

    stopped: list[Bare] = []
    monkeypatch.setattr(viser, "ViserServer", Bare)
    with pytest.raises(InputError, match="cannot be guarded; install viser"):
        open_server(LOOPBACK, 0, None)
    assert len(stopped) == 1
