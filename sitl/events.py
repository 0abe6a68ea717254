"""What a vehicle has to tell its stations, apart from its state."""

from dataclasses import dataclass


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
