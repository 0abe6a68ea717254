"""The autopilots that missions are written for."""

from enum import StrEnum


class Autopilot(StrEnum):
    """An autopilot, by the name that a user gives."""

    ardupilot = "ardupilot"
    px4 = "px4"

    @property
    def mav_autopilot(self) -> int:
        """Its MAV_AUTOPILOT number: in heartbeats, and the `firmwareType` of a .plan file."""
        return {Autopilot.ardupilot: 3, Autopilot.px4: 12}[self]

    @property
    def home_is_item_0(self) -> bool:
        """Whether missions on the wire begin with home; otherwise with the first item that is flown."""
        return self is Autopilot.ardupilot
