"""What the services ask of the vehicle behind them."""

import threading
from collections.abc import Sequence
from typing import Protocol

from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from sitl.events import ItemReached, StatusText
from sitl.modes import Mode
from sitl.parameters import Parameters
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
    def parameters(self) -> Parameters:
        """What it is set to."""

    @property
    def home(self) -> MissionItem:
        """Item 0 of every mission."""

    @property
    def mission(self) -> Mission:
        """The mission held; at least home."""

    def items(self, plan: PlanType) -> tuple[MissionItem, ...]:
        """The plan held of one type; a mission has at least home."""

    def load(self, plan: PlanType, items: Sequence[MissionItem]) -> None:
        """Take over a plan and keep it; the old one stays when that raises InputError, with the reason."""

    def snapshot(self) -> Snapshot:
        """Its state now."""

    def prearm(self) -> str | None:
        """Why it could not be armed now; changes nothing."""

    def arm(self, *, force: bool = False) -> str | None:
        """Arm, if the pre-arm checks pass or by force."""

    def disarm(self, *, force: bool = False) -> str | None:
        """Disarm; by force in the air too."""

    def set_mode(self, mode: Mode) -> str | None:
        """Change mode."""

    def start_mission(self) -> str | None:
        """Start the mission from its first item."""

    def set_current(self, seq: int) -> str | None:
        """Go on with this item of the mission (DO_SET_MISSION_CURRENT)."""

    def change_speed(self, speed_m_s: float, *, over_ground: bool) -> str | None:
        """Fly at another speed from now on (DO_CHANGE_SPEED); -2 goes back to the default."""

    def take_off(self, altitude_m: float) -> str | None:
        """Take off in mode TAKEOFF to an altitude above home (NAV_TAKEOFF)."""

    def reposition(self, item: MissionItem) -> str | None:
        """Fly to a place in mode GUIDED and circle there; param3 is the radius in metres, negative anticlockwise."""

    def set_home(self, home: MissionItem | None) -> str | None:
        """Change home; None for where it is now."""

    def enable_fence(self, enabled: bool) -> str | None:
        """Heed the fence, or not (DO_FENCE_ENABLE)."""

    def hear_station(self, now_s: float) -> None:
        """The station that it obeys has been heard, at this wall time."""

    def watch_station(self, now_s: float) -> None:
        """Wall time has passed: if the station has been silent for too long, do what is set for that."""

    def drain_events(self) -> list[ItemReached | StatusText]:
        """What happened since the last call."""
