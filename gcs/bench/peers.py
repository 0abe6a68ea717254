"""Other people's ground stations: here only when the extra `peers` is installed."""

import importlib
import socket
from types import ModuleType

from missions.errors import InputError

LOOPBACK = "127.0.0.1"
PATIENCE_S = 30.0
"""How long a foreign station may take over one step on a slow and busy machine."""


def peer_module(name: str) -> ModuleType:
    """A module of a foreign station; raises InputError when it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        text = f"{package} is not installed ({error}); install the extra: pip install 'skein-gcs[peers]'"
        raise InputError(text) from error


def free_udp_port() -> int:
    """A UDP port of the loopback that nobody has just now, for a station that must be told one."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind((LOOPBACK, 0))
        return int(probe.getsockname()[1])
