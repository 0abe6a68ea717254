"""What a vehicle has to tell its stations, apart from its state."""

from dataclasses import dataclass

CRITICAL, WARNING, NOTICE, INFO = 2, 4, 5, 6
"""Of MAV_SEVERITY."""


@dataclass(frozen=True)
class ItemReached:
    """Mission item `seq` has been flown (MISSION_ITEM_REACHED)."""

    seq: int


@dataclass(frozen=True)
class StatusText:
    """A line for the person at the station (STATUSTEXT).

    Attributes:
        severity: MAV_SEVERITY, 0 emergency to 7 debug.
        text: any length; the wire carries it in pieces of 50 bytes.
    """

    severity: int
    text: str
