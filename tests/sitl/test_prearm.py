"""Pre-arm checks: each says what is wrong, and force or ARMING_CHECK 0 skips them."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from missions.commands import Command, Frame
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.config import VehicleConfig
from sitl.modes import Mode

Place = Callable[..., MissionItem]


def test_manual_needs_no_mission(make_flown: Any) -> None:
    vehicle = make_flown().vehicle
    assert vehicle.prearm() is None
    assert vehicle.snapshot().ready
    assert vehicle.arm() is None


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        ({"AIRSPEED_MIN": 30, "AIRSPEED_MAX": 25}, "AIRSPEED_MIN 30 is not below AIRSPEED_MAX 25"),
        ({"AIRSPEED_MIN": 30}, "AIRSPEED_CRUISE 28 is not within"),
        ({"FENCE_ENABLE": 1}, "FENCE_TYPE wants polygons, and none are loaded"),
        ({"FENCE_ENABLE": 1, "FENCE_TYPE": 0}, "no fence to heed"),
        ({"FENCE_ENABLE": 1, "FENCE_TYPE": 9, "FENCE_ALT_MIN": 200}, "FENCE_ALT_MIN is not below"),
    ],
)
def test_what_is_set_wrong_is_named(make_flown: Any, settings: dict[str, float], reason: str) -> None:
    vehicle = make_flown().vehicle
    for name, value in settings.items():
        vehicle.parameters.set(name, value)
    assert reason in (vehicle.arm() or "")
    assert not vehicle.snapshot().armed
    assert not vehicle.snapshot().ready
    assert vehicle.arm(force=True) is None


def test_arming_check_0_skips_them(make_flown: Any) -> None:
    vehicle = make_flown().vehicle
    vehicle.parameters.set("AIRSPEED_MIN", 30)
    vehicle.parameters.set("ARMING_CHECK", 0)
    assert vehicle.arm() is None


def test_home_outside_the_fence_is_named(make_flown: Any, place: Place) -> None:
    vehicle = make_flown().vehicle
    vehicle.load(PlanType.FENCE, [place(Command.NAV_FENCE_CIRCLE_EXCLUSION, 0, 0, param1=100)])
    vehicle.parameters.set("FENCE_ENABLE", 1)
    assert vehicle.arm() == "Home is beyond the fence: inside a circle to stay out of"
    vehicle.set_home(replace(place(Command.NAV_WAYPOINT, 300, 0, 450), frame=Frame.GLOBAL))
    assert vehicle.arm() == "Vehicle is beyond the fence: inside a circle to stay out of"


def test_home_under_the_terrain_is_named(make_flown: Any, config: VehicleConfig) -> None:
    vehicle = make_flown(replace(config, home_m=(0.0, 0.0, -60.0))).vehicle
    assert vehicle.arm() == "Home is 60 m below the terrain: set it anew"


def test_auto_without_a_mission_and_modes_of_flight_are_not_armed(make_flown: Any, place: Place) -> None:
    vehicle = make_flown().vehicle
    vehicle.load(PlanType.MISSION, (vehicle.home, place(Command.NAV_WAYPOINT, 1500, 0, 80)))
    vehicle.set_mode(Mode.AUTO)
    vehicle.load(PlanType.MISSION, (vehicle.home,))
    assert vehicle.arm() == "AUTO without a mission: upload one"
