"""Fixtures that several floors share."""

import random
import socket
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, settings

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from sitl.events import ItemReached, StatusText
from sitl.modes import Mode
from sitl.parameters import INT16, REAL, Parameter, Parameters
from sitl.snapshot import LandedState, Snapshot
from sitl.store import Store

# Machines are shared: no test fails for the time that it took.
settings.register_profile("unhurried", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("unhurried")

PORTS = range(10_240, 32_768)
"""Systems give out ports above these only."""

HOME = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=465_000_000, lon_e7=113_000_000, alt_m=1200.0)


class FakeVehicle:
    """A vehicle for tests of its MAVLink face: it stands where it is put and believes what it is told."""

    def __init__(self, sysid: int) -> None:
        self.lock = threading.RLock()
        self.home = HOME
        self.mission = Mission((HOME,))
        self.others: dict[PlanType, tuple[MissionItem, ...]] = {PlanType.FENCE: (), PlanType.RALLY: ()}
        self.parameters = Parameters(
            [Parameter(f"SIM_{n}", REAL, float(n), -1e6, 1e6) for n in range(45)]
            + [
                Parameter("MAV_GCS_SYSID", INT16, 255, 1, 255),
                Parameter("MAV_SYSID", INT16, sysid, 1, 255),
                Parameter("SYSID_THISMAV", INT16, sysid, 1, 255, same_as="MAV_SYSID"),
                Parameter("TKOFF_ALT", REAL, 50.0, 0.0, 200.0),
                Parameter("WP_LOITER_RAD", INT16, 60, -32767, 32767),
                Parameter("WP_RADIUS", REAL, 90.0, 1.0, 32767.0),
                Parameter("MIS_TOTAL", INT16, 0, 0, 9, read_only=True),
            ],
            Store(),
        )
        self.asked: list[tuple[object, ...]] = []
        self.events: list[ItemReached | StatusText] = []
        self.refusal: str | None = None
        self.watched_at_s: float | None = None
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
            landed=LandedState.ON_GROUND,
            home_m=(0.0, 0.0, 1200.0),
            formation_delay_s=0.2,
        )

    @property
    def sysid(self) -> int:
        return int(self.parameters["MAV_SYSID"])

    def change(self, **changes: object) -> None:
        self.state = replace(self.state, **changes)  # type: ignore[arg-type]

    def snapshot(self) -> Snapshot:
        return self.state

    def items(self, plan: PlanType) -> tuple[MissionItem, ...]:
        return self.mission.items if plan == PlanType.MISSION else self.others[plan]

    def load(self, plan: PlanType, items: Sequence[MissionItem]) -> None:
        if self.refusal is not None:
            raise InputError(self.refusal)
        if plan == PlanType.MISSION:
            self.mission = Mission(tuple(items))
        else:
            self.others[plan] = tuple(items)

    def ask(self, *asked: object) -> str | None:
        self.asked.append(asked)
        return self.refusal

    def set_current(self, seq: int) -> str | None:
        return self.ask("set_current", seq)

    def change_speed(self, speed_m_s: float, *, over_ground: bool) -> str | None:
        return self.ask("change_speed", speed_m_s, over_ground)

    def take_off(self, altitude_m: float) -> str | None:
        return self.ask("take_off", altitude_m)

    def reposition(self, item: MissionItem) -> str | None:
        return self.ask("reposition", item)

    def set_home(self, home: MissionItem | None) -> str | None:
        return self.ask("set_home", home)

    def enable_fence(self, enabled: bool) -> str | None:
        return self.ask("enable_fence", enabled)

    def hear_station(self, now_s: float) -> None:
        self.ask("hear_station", now_s)

    def watch_station(self, now_s: float) -> None:
        self.watched_at_s = now_s

    def prearm(self) -> str | None:
        return "no mission: upload one first" if len(self.mission) == 1 else None

    def arm(self, *, force: bool = False) -> str | None:
        self.asked.append(("arm", force))
        if len(self.mission) == 1 and not force:
            return "no mission: upload one first"
        self.change(armed=True)
        return None

    def disarm(self, *, force: bool = False) -> str | None:
        self.asked.append(("disarm", force))
        if self.state.airborne and not force:
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


@pytest.fixture(scope="session")
def free_port() -> Callable[[], int]:
    """Gives ports that are free, another each time. A port that the system gives out and takes back may be given to
    whoever asks next, before it is used here."""

    def is_free(port: int) -> bool:
        try:
            for kind in (socket.SOCK_STREAM, socket.SOCK_DGRAM):
                with socket.socket(socket.AF_INET, kind) as trial:
                    trial.bind(("127.0.0.1", port))
        except OSError:
            return False
        return True

    ports = filter(is_free, iter(random.SystemRandom().sample(PORTS, len(PORTS))))
    return lambda: next(ports)
