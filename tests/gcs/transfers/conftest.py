"""The two ways to test a transfer: joined with a vehicle's servers, or with a vehicle that follows a script."""

from collections.abc import Callable
from typing import Any

import pytest

from gcs import station
from gcs.bench.lossy_link import Fates, LossyLink
from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.transfer import Transfer
from sitl.services.codec import Codec


class Scripted:
    """A transfer with a vehicle that says what a test makes it say; time is simulated.

    Attributes:
        sent: (kind, seq) of what the transfer has sent; seq is the type of a MISSION_ACK, None where there is none.
    """

    def __init__(self) -> None:
        self.time_s = 0.0
        self.sent: list[tuple[str, int | None]] = []
        self.known = Acquaintance()
        self._transfer: Transfer[Any] | None = None
        self._ours, self._theirs = Codec(station.SYSID, station.COMPID), Codec(3, 1)

    def link(self) -> tuple[Any, ...]:
        """The last arguments of a transfer."""
        return (3, 1, self._send, lambda: self.time_s, self.known)

    def start(self, transfer: Transfer[Any]) -> None:
        self._transfer = transfer
        transfer.start()

    def say(self, message: Any) -> None:
        """The vehicle says something."""
        assert self._transfer is not None
        self._transfer.on_message(self._ours.feed(self._theirs.pack(message))[0])

    def wait(self, seconds: float) -> None:
        """Time passes."""
        assert self._transfer is not None
        end_s = self.time_s + seconds
        while self.time_s < end_s:
            self.time_s += 0.05
            self._transfer.on_tick()

    def _send(self, message: Any) -> None:
        self.sent.append((message.get_type(), getattr(message, "seq", getattr(message, "type", None))))


@pytest.fixture
def scripted() -> Scripted:
    return Scripted()


@pytest.fixture
def lossy_link() -> Callable[..., LossyLink]:
    """Joins a vehicle's servers to a transfer; arguments of Fates after the vehicle."""
    return lambda vehicle, *fates: LossyLink(vehicle, Fates(*fates))
