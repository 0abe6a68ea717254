"""Who is at the other end of a link, and which station is speaking through it."""

import ipaddress
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

Message: TypeAlias = Any
"""A message of pymavlink's ardupilotmega dialect; pymavlink is untyped."""


class Peer(NamedTuple):
    """One UDP address or TCP connection."""

    transport: str
    host: str
    port: int

    def __str__(self) -> str:
        return f"{self.transport} {self.host}:{self.port}"

    @property
    def is_local(self) -> bool:
        """Whether no network lies between: a serial device, or this machine's loopback."""
        if self.transport == "serial" or self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False


class Station(NamedTuple):
    """One MAVLink participant behind a peer: two stations may share an address, and two addresses a system id."""

    peer: Peer
    sysid: int
    compid: int

    @classmethod
    def of(cls, message: Message, peer: Peer) -> "Station":
        """The sender of `message`."""
        return cls(peer, message.get_srcSystem(), message.get_srcComponent())


Send: TypeAlias = Callable[[Message, Peer], None]
"""Puts one message on the wire to one peer."""
