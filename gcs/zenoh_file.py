"""The file that describes how a swarm meets over Zenoh, the same on all its machines:

    swarm = "field"                    # in all keys
    router = "tls/10.0.0.1:7447"       # where `skein router` listens; tcp/... goes without certificates
    ca = "ca.pem"                      # signed the certificates of all
    certificate = "{name}.pem"         # of router, station, vehicle-1, vehicle-2, ...: also their common names
    key = "{name}.key"

Paths are relative to the file.
"""

import re
import tomllib
from pathlib import Path
from typing import Any

from missions.errors import InputError
from sitl.zenoh_network import ZenohNetwork

_NEEDED = ("swarm", "router")
_CERTIFICATES = ("ca", "certificate", "key")


def read_zenoh_file(file: Path) -> ZenohNetwork:
    """Read such a file.

    Raises:
        InputError: it cannot be read, or something in it is wrong; the message names file and key.
    """
    try:
        values = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: {error}") from None
    try:
        return _network(values, file.parent)
    except InputError as error:
        raise InputError(f"{file}: {error}") from None


def _network(values: dict[str, Any], folder: Path) -> ZenohNetwork:
    for key, value in values.items():
        if key not in _NEEDED + _CERTIFICATES:
            raise InputError(f"{key}: no such key; there are {', '.join(_NEEDED + _CERTIFICATES)}")
        if not isinstance(value, str) or not value:
            raise InputError(f"{key}: must be text in quotes, got {value!r}")
    for key in _NEEDED:
        if key not in values:
            raise InputError(f"{key}: is missing")
    swarm, router = values["swarm"], values["router"]
    if not re.fullmatch(r"[A-Za-z0-9_-]+", swarm):
        raise InputError(f"swarm: letters, digits, - and _ only, got {swarm!r}")
    if not re.fullmatch(r"(tcp|tls)/[^/]+:\d+", router):
        raise InputError(f"router: write tls/HOST:PORT or tcp/HOST:PORT, got {router!r}")
    given = [key for key in _CERTIFICATES if key in values]
    if router.startswith("tcp/") and given:
        raise InputError(f"{given[0]}: certificates go with a router at tls/..., not {router}")
    if router.startswith("tls/") and len(given) < len(_CERTIFICATES):
        raise InputError(f"router: at tls/... all of {', '.join(_CERTIFICATES)} are needed")
    return ZenohNetwork(swarm, router, *(folder / values[key] for key in given))
