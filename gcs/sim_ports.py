"""The ports of the swarms of `skein sim` on one machine: none clash, whatever their sizes."""

import contextlib
import ipaddress
import os
import socket

from missions.errors import InputError
from sitl.services.links import LOOPBACK

TCP_BASE, TCP_STEP = 5760, 10
"""ArduPilot's simulators': the first vehicle's, and from one vehicle to the next."""
TCP_INSTANCE_STEP = 2500
"""Between the instances: room for all the system ids there are."""
UDP_BASE, UDP_INSTANCE_STEP = 14550, 10
"""Where ground stations listen, and between ArduPilot's instances."""
LAST_INSTANCE = 9
"""Beyond it lie the ports that Linux gives to whoever asks for any."""


def tcp_base(instance: int) -> int:
    """TCP port of the first vehicle of an instance."""
    return TCP_BASE + TCP_INSTANCE_STEP * instance


def udp_port(instance: int) -> int:
    """Where the telemetry of an instance goes."""
    return UDP_BASE + UDP_INSTANCE_STEP * instance


def require_free_tcp(base: int, count: int) -> None:
    """Raises InputError when the port of one of `count` vehicles is taken, or there are not so many."""
    last = base + TCP_STEP * (count - 1)
    if last > 65535:
        raise InputError(f"--tcp-port {base}: {count} vehicles would need ports up to {last}; choose a lower one")
    for port in range(base, last + 1, TCP_STEP):
        with contextlib.closing(socket.socket(socket.AF_INET, socket.SOCK_STREAM)) as probe:
            if os.name == "posix":
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((LOOPBACK, port))
            except OSError as error:
                raise InputError(
                    f"TCP port {port}: {error.strerror}, perhaps by another swarm; give this one --instance 1 "
                    "(or 2, ...), or --tcp-port 0 for free ports"
                ) from error


def parse_station(text: str) -> tuple[str, int]:
    """HOST:PORT of a ground station on this machine, as --udp takes it.

    Raises:
        InputError: it is no such thing.
    """
    host, _, port = text.rpartition(":")
    host = LOOPBACK if host in ("", "localhost") else host
    try:
        address = ipaddress.IPv4Address(host)
        number = int(port)
    except ValueError:
        raise InputError(f"--udp {text}: give HOST:PORT, as in 127.0.0.1:14550") from None
    if not 0 < number < 65536:
        raise InputError(f"--udp {text}: a port is a number from 1 to 65535")
    if not address.is_loopback:
        raise InputError(f"--udp {text}: the vehicles talk to stations on this machine only, as on 127.0.0.1")
    return str(address), number
