"""Who may come in: pages of this console alone, on this machine; from elsewhere only those who have the token.

Browsers let any page of any site connect to a WebSocket on the reader's own machine, and one of a console can abort a
flight. So the Origin that a browser names must be the console's own, and the Host one that it is reached by.
"""

import hmac
import http
import re
from ipaddress import ip_address
from urllib.parse import parse_qs

from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

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
        if origin is not None and origin.partition("://")[2] != host:
            return _answer(http.HTTPStatus.FORBIDDEN, REFUSED)
        if self._token is None:
            local = is_loopback(re.sub(r":\d+$", "", host).strip("[]"))
            return None if local else _answer(http.HTTPStatus.FORBIDDEN, REFUSED)
        query = request.path.partition("?")[2]
        name = f"skein_{host.rpartition(':')[2]}"
        if self._is_token(parse_qs(query).get("token", [""])[0]):
            cookie = f"{name}={self._token}; Path=/; HttpOnly; SameSite=Lax"
            return _answer(http.HTTPStatus.SEE_OTHER, "", {"Location": "/", "Set-Cookie": cookie})
        return None if self._is_token(_cookie(request, name)) else _answer(http.HTTPStatus.FORBIDDEN, REFUSED)

    def _is_token(self, text: str) -> bool:
        return self._token is not None and hmac.compare_digest(text.encode(), self._token.encode())


def is_loopback(host: str) -> bool:
    """Whether a host, by name or address, is this machine and can be nothing else."""
    try:
        return host == "localhost" or ip_address(host).is_loopback
    except ValueError:  # another name, which whoever owns it can turn to anything
        return False


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
