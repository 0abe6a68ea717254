"""Fixtures that several floors share."""

import threading
from collections.abc import Callable
from dataclasses import replace

import pytest

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from sitl.events import ItemReached, StatusText
from sitl.modes import Mode
from sitl.snapshot import Snapshot

HOME = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=465_000_000, lon_e7=113_000_000, alt_m=1200.0)


class FakeVehicle:
    """A vehicle for tests of its MAVLink face: it stands where it is put and believes what it is told."""

    def __init__(self, sysid: int) -> None:
        self.sysid = sysid
        self.lock = threading.RLock()
        self.home = HOME
        self.mission = Mission((HOME,))
        self.events: list[ItemReached | StatusText] = []
        self.refusal: str | None = None
        self.state = Snapshot(
            time_s=0.0,
            mode=Mode.MANUAL,
            armed=False,
            airborne=False,
            position_m=(0.0, 0.0, 1200.0),
            ground_velocity_m_s=(0.0, 0.0, 0.0),
            airspeed_m_s=0.0,
            climb_angle=0.0,
            heading=0.0,
            bank=0.0,
            thrust_fraction=0.0,
            wind_m_s=(0.0, 0.0, 0.0),
            airspeed_wanted_m_s=0.0,
            current_seq=0,
            mission_complete=False,
            cross_track_m=0.0,
            altitude_error_m=0.0,
            along_track_m=0.0,
            distance_to_waypoint_m=0.0,
        )

    def change(self, **changes: object) -> None:
        self.state = replace(self.state, **changes)  # type: ignore[arg-type]

    def snapshot(self) -> Snapshot:
        return self.state

    def load_mission(self, mission: Mission) -> None:
        if self.refusal is not None:
            raise InputError(self.refusal)
        self.mission = mission

    def arm(self) -> str | None:
        if len(self.mission) == 1:
            return "no mission: upload one first"
        self.change(armed=True)
        return None

    def disarm(self) -> str | None:
        if self.state.airborne:
            return "in flight"
        self.change(armed=False)
        return None

    def set_mode(self, mode: Mode) -> str | None:
        self.change(mode=mode)
        return None

    def start_mission(self) -> str | None:
        self.change(mode=Mode.AUTO)
        return None

    def drain_events(self) -> list[ItemReached | StatusText]:
        events, self.events = self.events, []
        return events


@pytest.fixture
def make_vehicle() -> Callable[[int], FakeVehicle]:
    return FakeVehicle


@pytest.fixture
def make_mission() -> Callable[[int], Mission]:
    """Missions of a given number of items, home included: speeds and waypoints in turn."""

    def make(count: int) -> Mission:
        items = [HOME]
        for seq in range(1, count):
            if seq % 3 == 2:
                items.append(MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 0.0, 20.0 + seq / 7, -1.0))
            else:
                lat_e7, lon_e7 = HOME.lat_e7 + 1237 * seq, HOME.lon_e7 - 4321 * seq
                items.append(
                    MissionItem(
                        Command.NAV_WAYPOINT, Frame.GLOBAL, 0.0, 50.0, 0.0, 0.0, lat_e7, lon_e7, 1500.0 + seq / 3
                    )
                )
        return Mission(tuple(items))

    return make


@pytest.fixture
def frame() -> LocalFrame:
    return LocalFrame(46.5, 11.3, 0.0)
