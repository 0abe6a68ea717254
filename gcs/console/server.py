"""The web server of a console: viser's, behind a door."""

import contextlib
import errno
import io
import socket
from collections.abc import Iterator
from typing import Any

import viser
import websockets.asyncio.server

from gcs.console.door import Door
from missions.errors import InputError

LAST_PORT = 65535


def open_server(host: str, port: int, token: str | None) -> viser.ViserServer:
    """Serve a page.

    Args:
        host: address to listen on.
        port: where that is free, else the next one that is; 0 for any.
        token: that browsers must have; None for none.

    Raises:
        InputError: nobody can listen there.
    """
    port = _free_port(host, port)  # viser would try for ever
    with _guarded(Door(token)) as served, _quiet():
        server = viser.ViserServer(host=host, port=port, verbose=False)
    if not served:
        close_server(server)
        raise InputError(f"viser {viser.__version__} cannot be guarded; install viser 1.1")
    return server


def close_server(server: viser.ViserServer) -> None:
    """Serve no more."""
    with _quiet():
        server.stop()


def _free_port(host: str, first: int) -> int:
    """The first port from this one on that is free; 0 for any. Raises InputError when nobody can listen there."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    for port in range(first, LAST_PORT + 1):
        try:
            socket.create_server((host, port), family=family).close()
        except OSError as error:
            if error.errno not in (errno.EADDRINUSE, errno.EACCES):
                raise InputError(f"--host {host}: {error.strerror or error}; name an address of this machine") from None
        else:
            return port
    raise InputError(f"--port {first}: taken, and all after it, too; choose another, or 0 for any")


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """viser prints when it begins and ends; what commands print is theirs."""
    with contextlib.redirect_stdout(io.StringIO()):
        yield


@contextlib.contextmanager
def _guarded(door: Door) -> Iterator[list[bool]]:
    """Within this context viser's server gets a door: it asks nobody who comes in, and has no place for one that does.

    Yields a list that is not empty once that has been done.
    """
    serve = websockets.asyncio.server.serve
    served: list[bool] = []

    def serve_behind_door(*args: Any, process_request: Any, **options: Any) -> Any:
        def judged(connection: Any, request: Any) -> Any:
            return door.judge(connection, request) or process_request(connection, request)

        served.append(True)
        return serve(*args, process_request=judged, **options)

    websockets.asyncio.server.serve = serve_behind_door  # type: ignore[assignment,misc]
    try:
        yield served
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]
