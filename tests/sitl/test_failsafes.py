"""What a vehicle does on its own: at its fence, and when its station falls silent."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from missions.commands import Command
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.modes import Mode
from sitl.snapshot import Breach

Place = Callable[..., MissionItem]


def fenced(flown: Any, **settings: float) -> Any:
    for name, value in settings.items():
        flown.vehicle.parameters.set(f"FENCE_{name}", value)
    assert flown.vehicle.enable_fence(True) is None
    return flown


@pytest.mark.parametrize(("action", "mode"), [(0, Mode.GUIDED), (1, Mode.RTL), (6, Mode.GUIDED), (8, Mode.RTL)])
def test_crossing_the_circle_does_what_is_set_once(make_flown: Any, place: Place, action: int, mode: Mode) -> None:
    flown = fenced(make_flown().taken_off(), TYPE=2, RADIUS=1200, ACTION=action)
    flown.vehicle.reposition(place(Command.NAV_LOITER_UNLIM, 3000, 0, 100))
    flown.fly_s(60)
    now = flown.vehicle.snapshot()
    assert (now.mode, now.breach_count, now.breach_type) == (mode, 1, Breach.BOUNDARY)
    assert sum(text.startswith("Fence breached, 120") for text in flown.texts) == 1
    assert now.breach_status == (action == 0)
    assert ("Back inside the fence" in flown.texts) == (action != 0)
    assert not now.failsafe


def test_the_return_point_is_flown_to(make_flown: Any, place: Place) -> None:
    flown = fenced(make_flown().taken_off(), TYPE=6, RADIUS=1200, ACTION=6, RET_ALT=140)
    corners = [(-2000, -2000), (2000, -2000), (2000, 2000), (-2000, 2000)]
    vertices = [place(Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION, *corner, param1=4) for corner in corners]
    flown.vehicle.load(PlanType.FENCE, [place(Command.NAV_FENCE_RETURN_POINT, -500, 300), *vertices])
    assert flown.vehicle.parameters["FENCE_TOTAL"] == 5
    flown.vehicle.reposition(place(Command.NAV_LOITER_UNLIM, 0, 3000, 100))
    rows = flown.fly_s(250)
    assert np.hypot(rows[-1, 0] + 500, rows[-1, 1] - 300) == pytest.approx(283, abs=40)
    assert rows[-1, 2] == pytest.approx(140, abs=6)


def test_altitude_fences_count_after_take_off_and_not_while_landing(make_flown: Any, place: Place) -> None:
    flown = make_flown()
    fenced(flown, TYPE=9, ALT_MIN=30, ALT_MAX=120, ACTION=0)
    flown.in_auto(
        place(Command.NAV_WAYPOINT, 1500, 0, 90),
        place(Command.NAV_WAYPOINT, 1500, 900, 60),
        place(Command.NAV_LAND, 500, 900, 0),
    )
    flown.fly_s(200)
    assert flown.texts == ["Launched", "Touchdown", "Landed and disarmed"]
    assert flown.vehicle.snapshot().breach_count == 0


def test_flying_too_high_is_a_breach_and_coming_down_ends_it(make_flown: Any, place: Place) -> None:
    flown = fenced(make_flown().taken_off(), TYPE=1, ALT_MAX=120, ACTION=1)
    flown.vehicle.reposition(place(Command.NAV_LOITER_UNLIM, 500, 0, 200))
    flown.fly_s(120)
    now = flown.vehicle.snapshot()
    assert (now.mode, now.breach_type, now.breach_status) == (Mode.RTL, Breach.MAXALT, False)


def test_without_a_fence_there_is_none_to_enable(make_flown: Any) -> None:
    vehicle = make_flown().vehicle
    assert vehicle.enable_fence(True) == "FENCE_TYPE wants polygons, and none are loaded"
    assert vehicle.enable_fence(False) is None


@pytest.mark.parametrize(
    ("enabled", "action", "mode"), [(0, 1, Mode.LOITER), (1, 0, Mode.LOITER), (1, 1, Mode.RTL), (3, 1, Mode.LOITER)]
)
def test_a_silent_station_leads_to_what_is_set(make_flown: Any, enabled: int, action: int, mode: Mode) -> None:
    flown = make_flown().taken_off()
    flown.vehicle.set_mode(Mode.LOITER)
    flown.vehicle.parameters.set("FS_GCS_ENABL", enabled)
    flown.vehicle.parameters.set("FS_LONG_ACTN", action)
    flown.vehicle.hear_station(1000.0)
    flown.vehicle.watch_station(1019.0)
    assert flown.vehicle.snapshot().mode == Mode.LOITER
    for now_s in (1021.0, 1022.0):
        flown.vehicle.watch_station(now_s)
    flown.hear()
    assert flown.vehicle.snapshot().mode == mode
    heeds = enabled == 1
    assert sum(text.startswith("Station lost for 20 s") for text in flown.texts) == heeds
    assert flown.vehicle.snapshot().failsafe == heeds
    flown.vehicle.hear_station(1030.0)
    flown.hear()
    assert ("Station is back" in flown.texts) == heeds
    assert not flown.vehicle.snapshot().failsafe


def test_a_station_never_heard_is_not_missed_nor_one_on_the_ground(make_flown: Any) -> None:
    flown = make_flown()
    flown.vehicle.parameters.set("FS_GCS_ENABL", 1)
    flown.vehicle.hear_station(0.0)
    flown.vehicle.watch_station(500.0)
    other = make_flown().taken_off()
    other.vehicle.parameters.set("FS_GCS_ENABL", 1)
    other.vehicle.watch_station(500.0)
    for vehicle in (flown, other):
        vehicle.hear()
        assert not any("Station" in text for text in vehicle.texts)
