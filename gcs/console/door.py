"""Who may come in: pages of this console alone, on this machine; from elsewhere only those who have the token.

Browsers let any page of any site connect to a WebSocket on the reader's own machine, and one of a console can abort a
flight. So the Origin that a browser names must be the console's own, and the Host one that it is reached by.
"""

import hmac
import http
from urllib.parse import parse_qs, urlsplit

from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

LOOPBACK_NAMES = ("127.0.0.1", "localhost", "[::1]")
REFUSED = "403: open the address that `skein console` has printed\n"


class Door:
    """Judges requests.

    Args:
        token: that those who come must have; None on the loopback interface.
    """

    def __init__(self, token: str | None) -> None:
        self._token = token

    def judge(self, connection: ServerConnection, request: Request) -> Response | None:
        """What to answer instead of what was asked for; None for those who may come in."""
        host = request.headers.get("Host", "")
        origin = request.headers.get("Origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return _answer(http.HTTPStatus.FORBIDDEN, REFUSED)
        if self._token is None:
            local = host.rpartition(":")[0] in LOOPBACK_NAMES
            return None if local else _answer(http.HTTPStatus.FORBIDDEN, REFUSED)
        address = urlsplit(request.path)
        name = f"skein_{host.rpartition(':')[2]}"
        if self._is_token(parse_qs(address.query).get("token", [""])[0]):
            cookie = f"{name}={self._token}; Path=/; HttpOnly; SameSite=Lax"
            return _answer(http.HTTPStatus.SEE_OTHER, "", {"Location": address.path, "Set-Cookie": cookie})
        return None if self._is_token(_cookie(request, name)) else _answer(http.HTTPStatus.FORBIDDEN, REFUSED)

    def _is_token(self, text: str) -> bool:
        return self._token is not None and hmac.compare_digest(text.encode(), self._token.encode())


def _cookie(request: Request, name: str) -> str:
    for header in request.headers.get_all("Cookie"):
        for pair in header.split(";"):
            key, _, value = pair.strip().partition("=")
            if key == name:
                return value
    return ""


def _answer(status: http.HTTPStatus, text: str, headers: dict[str, str] | None = None) -> Response:
    body = text.encode()
    all_headers = {"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body))} | (headers or {})
    return Response(status, status.phrase, Headers(all_headers), body)
