"""What the services ask of the vehicle behind them."""

import threading
from typing import Protocol

from missions.mission import Mission, MissionItem
from sitl.events import ItemReached, StatusText
from sitl.modes import Mode
from sitl.snapshot import Snapshot


class Vehicle(Protocol):
    """A vehicle that can be told and asked things; `lock` is held around every call.

    The commands return None when done, else the reason why not.
    """

    @property
    def sysid(self) -> int:
        """MAVLink system id."""

    @property
    def lock(self) -> threading.RLock:
        """Held by whoever uses the vehicle."""

    @property
    def home(self) -> MissionItem:
        """Item 0 of every mission."""

    @property
    def mission(self) -> Mission:
        """The mission held; at least home."""

    def snapshot(self) -> Snapshot:
        """Its state now."""

    def load_mission(self, mission: Mission) -> None:
        """Take over a mission; raises InputError with the reason when it cannot be flown."""

    def arm(self) -> str | None:
        """Arm."""

    def disarm(self) -> str | None:
        """Disarm."""

    def set_mode(self, mode: Mode) -> str | None:
        """Change mode."""

    def start_mission(self) -> str | None:
        """Start the mission."""

    def drain_events(self) -> list[ItemReached | StatusText]:
        """What happened since the last call."""
