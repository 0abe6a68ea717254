"""Who may come in: over real sockets, as browsers and as those who would be browsers."""

import http.client
from collections.abc import Callable
from typing import Any

import pytest
import viser
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from gcs.console.door import is_loopback

TOKEN = "a-token-that-nobody-guesses"
PATIENCE_S = 60.0


class Knocker:
    """Somebody who asks a console for something.

    Args:
        port: of the console.
    """

    def __init__(self, port: int) -> None:
        self.port = port
        self.own = f"127.0.0.1:{port}"

    def get(self, path: str = "/", **headers: str) -> tuple[int, dict[str, str]]:
        """What is answered: status and headers."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        try:
            connection.request("GET", path, headers={"Host": self.own} | headers)
            answer = connection.getresponse()
            answer.read()
            return answer.status, dict(answer.getheaders())
        finally:
            connection.close()

    def websocket(self, path: str = "/", host: str | None = None, **options: Any) -> int:
        """Status with which a websocket is refused; 101 for one that was opened."""
        version: Any = f"viser-v{viser.__version__}"
        try:
            with connect(
                f"ws://{host or self.own}{path}",
                subprotocols=[version],
                open_timeout=PATIENCE_S,
                close_timeout=PATIENCE_S,
                proxy=None,
                **options,
            ):
                return 101
        except InvalidStatus as error:
            return error.response.status_code


@pytest.fixture(scope="module")
def open_door(serve_pages: Callable[..., viser.ViserServer]) -> Knocker:
    """At a console without a token."""
    return Knocker(serve_pages().get_port())


@pytest.fixture(scope="module")
def locked_door(serve_pages: Callable[..., viser.ViserServer]) -> Knocker:
    """At one with a token."""
    return Knocker(serve_pages(token=TOKEN).get_port())


def test_on_this_machine_the_page_and_its_socket_are_open(open_door: Knocker) -> None:
    assert open_door.get()[0] == 200
    assert open_door.websocket(origin=f"http://{open_door.own}") == 101
    assert open_door.websocket() == 101, "a client that is no browser names no origin"


@pytest.mark.parametrize("name", ["localhost", "127.0.0.1", "127.8.9.10", "[::1]"])
def test_every_name_of_the_loopback_interface_is_its_own(open_door: Knocker, name: str) -> None:
    assert open_door.get(Host=f"{name}:{open_door.port}")[0] == 200
    assert open_door.get(Host=name)[0] == 200, "at port 80 browsers name none"


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "https://127.0.0.1", "null", "http://127.0.0.1:1", "http://[", ""]
)
def test_pages_of_other_sites_are_refused(open_door: Knocker, origin: str) -> None:
    assert open_door.get(Origin=origin)[0] == 403
    assert open_door.websocket(origin=origin) == 403


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "10.0.0.1", "[", ""]
)
def test_names_that_somebody_else_has_turned_to_this_machine_are_refused(open_door: Knocker, host: str) -> None:
    """As in DNS rebinding, where the page is of the same origin as the socket."""
    name = f"{host}:{open_door.port}"
    assert open_door.get(Host=name)[0] == 403
    assert open_door.get(Host=name, Origin=f"http://{name}")[0] == 403


def test_without_the_token_nobody_comes_in(locked_door: Knocker) -> None:
    for path in (
        "/",
        "/?token=",
        "/?token=wrong",
        f"/?token={TOKEN}x",
        f"/?token={TOKEN[:-1]}",
        "/?token=%ff",
        "//[?token=",
    ):
        status, headers = locked_door.get(path)
        assert (status, "Set-Cookie" in headers) == (403, False), path
        assert locked_door.websocket(path) == 403, path


def test_with_the_token_a_browser_gets_a_cookie_and_the_address_without_it(locked_door: Knocker) -> None:
    status, headers = locked_door.get(f"/?token={TOKEN}")
    assert (status, headers["Location"]) == (303, "/")
    cookie, *attributes = headers["Set-Cookie"].split("; ")
    assert {"HttpOnly", "SameSite=Lax", "Path=/"} == set(attributes)
    assert locked_door.get(Cookie=cookie)[0] == 200
    assert locked_door.get(Cookie=f"other=1; {cookie}")[0] == 200
    assert locked_door.websocket(additional_headers={"Cookie": cookie}) == 101


def test_a_wrong_cookie_is_none(locked_door: Knocker) -> None:
    cookie = locked_door.get(f"/?token={TOKEN}")[1]["Set-Cookie"].split("; ")[0]
    name, _, value = cookie.partition("=")
    for wrong in (f"{name}=", f"{name}={value}x", f"{name}x={value}", value, "é"):
        assert locked_door.get(Cookie=wrong)[0] == 403, wrong


def test_a_cookie_does_not_open_for_pages_of_other_sites(locked_door: Knocker) -> None:
    """A browser sends it along, whosever page it is that connects."""
    cookie = locked_door.get(f"/?token={TOKEN}")[1]["Set-Cookie"].split("; ")[0]
    assert locked_door.get(Cookie=cookie, Origin="http://evil.example")[0] == 403
    assert locked_door.websocket(additional_headers={"Cookie": cookie}, origin="http://evil.example") == 403


def test_with_a_token_it_may_be_reached_by_any_name(locked_door: Knocker) -> None:
    host = f"planes.example:{locked_door.port}"
    status, headers = locked_door.get(f"/?token={TOKEN}", Host=host)
    assert status == 303
    cookie = headers["Set-Cookie"].split("; ")[0]
    assert locked_door.get(Host=host, Cookie=cookie, Origin=f"http://{host}")[0] == 200


def test_files_outside_the_page_are_nobodys(open_door: Knocker) -> None:
    for path in ("/../server.py", "/%2e%2e/server.py", "/..%5c..%5cserver.py", "/etc/passwd"):
        assert open_door.get(path)[0] == 404, path


@pytest.mark.parametrize(
    ("host", "local"),
    [("127.0.0.1", True), ("127.0.0.2", True), ("::1", True), ("localhost", True), ("0.0.0.0", False), ("::", False),
     ("10.1.2.3", False), ("planes.example", False), ("", False)],
)  # fmt: skip
def test_what_is_on_this_machine_alone(host: str, local: bool) -> None:
    assert is_loopback(host) is local
