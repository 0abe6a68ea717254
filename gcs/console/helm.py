"""What a user may do to a swarm that flies: what each source of moments offers, as the page calls it."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol


class Order(Enum):
    """What a vehicle may be told; the value is what people read."""

    AUTO = "AUTO"
    LOITER = "LOITER"
    RTL = "RTL"
    ABORT = "abort"


class Pilots(Protocol):
    """Those who obey orders."""

    async def order(self, order: Order, sysids: Sequence[int]) -> list[str]:
        """Give vehicles an order and see that they obey; a line for each that says what came of it."""


class ClockHelm(Protocol):
    """The clocks of a simulated swarm."""

    @property
    def held(self) -> bool:
        """Whether they stand still."""

    async def hold(self) -> None:
        """Let them stand still. Raises InputError."""

    async def release(self) -> None:
        """Let them go on. Raises InputError."""

    async def pace(self, speed: float) -> None:
        """Set their speed. Raises InputError."""


class NetworkHelm(Protocol):
    """The network of a simulated swarm, and its vehicles' lives."""

    async def disturb(self, delay_s: float, loss: float) -> str:
        """Delay all corrections by so much more, lose such a share of them; says from when on. Raises InputError."""

    async def kill(self, sysid: int) -> str:
        """End a vehicle's process; says what came of it."""


@dataclass(frozen=True)
class Helm:
    """What may be done; None where it may not."""

    pilots: Pilots | None = None
    clock: ClockHelm | None = None
    network: NetworkHelm | None = None
