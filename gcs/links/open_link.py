"""Links by URL, in the manner of MAVSDK and pymavlink."""

import logging
import re
from urllib.parse import SplitResult, urlsplit

from gcs.links.link import Link
from gcs.links.serial_port import SerialLink
from gcs.links.tcp import TcpLink
from gcs.links.tcp_server import TcpServerLink
from gcs.links.udp import UdpLink
from missions.errors import InputError

_log = logging.getLogger(__name__)

DEFAULT_URL = "udpin://127.0.0.1:14550"
LOOPBACK = "127.0.0.1"
ACCEPTED = (
    "udpin://[HOST]:PORT (listen), udpout://HOST:PORT (send first), tcp://HOST:PORT or tcpout:// (connect), "
    "tcpin://[HOST]:PORT (listen), serial:///dev/DEVICE:BAUD"
)
_SERIAL = re.compile(r"serial://(?P<device>/.+):(?P<baud>\d+)")


async def open_link(url: str) -> Link:
    """Open the link that a URL names.

    A port is listened on at loopback, unless the URL names another host, 0.0.0.0 for all interfaces. Port 0 is a free
    one.

    Raises:
        InputError: the URL is none of those accepted, or the link cannot be had.
    """
    _log.info("%s: opening", url)
    if url.startswith("serial:"):
        found = _SERIAL.fullmatch(url)
        if found is None:
            raise InputError(f"{url}: no serial device and baud rate, as in serial:///dev/ttyUSB0:57600")
        return await SerialLink.open(found["device"], int(found["baud"]))
    try:
        parts = urlsplit(url)
    except ValueError as error:
        raise InputError(f"{url}: {error}; accepted are {ACCEPTED}") from error
    match parts.scheme:
        case "udpin" | "udp":
            return await UdpLink.open(_port(url, parts), parts.hostname or LOOPBACK)
        case "udpout":
            return await UdpLink.connect(_host(url, parts), _port(url, parts, lowest=1))
        case "tcp" | "tcpout":
            return await TcpLink.connect(_host(url, parts), _port(url, parts, lowest=1))
        case "tcpin":
            return await TcpServerLink.open(_port(url, parts), parts.hostname or LOOPBACK)
    raise InputError(f"{url}: unknown kind of link; accepted are {ACCEPTED}")


def _host(url: str, parts: SplitResult) -> str:
    if not parts.hostname:
        raise InputError(f"{url}: no host to send to; accepted are {ACCEPTED}")
    return parts.hostname


def _port(url: str, parts: SplitResult, lowest: int = 0) -> int:
    try:
        port = parts.port
    except ValueError:
        port = None
    if port is None or port < lowest or parts.path or parts.query:
        raise InputError(f"{url}: no port of {lowest} to 65535 at the end; accepted are {ACCEPTED}")
    return port
