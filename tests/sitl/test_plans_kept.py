"""Plans outlive the process: whole, or the old one."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from missions.commands import Command
from missions.errors import InputError
from missions.mission import MissionItem
from missions.plan_type import HELD, PlanType
from sitl.store import Store

Place = Callable[..., MissionItem]


def plans(place: Place, home: MissionItem) -> dict[PlanType, tuple[MissionItem, ...]]:
    return {
        PlanType.MISSION: (
            home,
            place(Command.NAV_WAYPOINT, 1500, 0, 80),
            place(Command.NAV_LOITER_TIME, 0, 900, 80, param1=9),
        ),
        PlanType.FENCE: (place(Command.NAV_FENCE_CIRCLE_INCLUSION, 0, 0, param1=5000),),
        PlanType.RALLY: (place(Command.NAV_RALLY_POINT, 500, 0, 70),),
    }


def test_a_new_process_has_the_plans_of_the_old_one(make_flown: Any, place: Place, tmp_path: Path) -> None:
    one = make_flown(store=Store(tmp_path / "memory")).vehicle
    kept = plans(place, one.home)
    for plan, items in kept.items():
        one.load(plan, items)
    other = make_flown(store=Store(tmp_path / "memory"))
    assert {plan: other.vehicle.items(plan) for plan in HELD} == kept
    assert [other.vehicle.parameters[name] for name in ("MIS_TOTAL", "FENCE_TOTAL", "RALLY_TOTAL")] == [3, 1, 1]
    assert other.texts == []
    assert other.vehicle.arm() is None
    assert other.vehicle.start_mission() is None
    other.fly_s(1)
    assert other.vehicle.airborne


def test_damage_is_said_and_the_rest_is_there(make_flown: Any, place: Place, tmp_path: Path) -> None:
    one = make_flown(store=Store(tmp_path / "memory")).vehicle
    kept = plans(place, one.home)
    for plan, items in kept.items():
        one.load(plan, items)
    file = tmp_path / "memory" / "mission.plan"
    file.write_bytes(file.read_bytes()[:-3] + b"abc")
    other = make_flown(store=Store(tmp_path / "memory"))
    assert other.vehicle.items(PlanType.MISSION) == (other.vehicle.home,)
    assert other.vehicle.items(PlanType.RALLY) == kept[PlanType.RALLY]
    assert [text for text in other.texts if text.startswith("Kept mission not used")]


def test_a_plan_that_cannot_be_flown_any_more_is_left_out(make_flown: Any, place: Place, tmp_path: Path) -> None:
    from sitl.plan_memory import keep_plan

    store = Store(tmp_path / "memory")
    keep_plan(store, PlanType.MISSION, (place(Command.NAV_WAYPOINT), place(Command.NAV_LAND, 500, 0, 0)))
    flown = make_flown(store=store)
    assert len(flown.vehicle.mission) == 1
    assert flown.texts == ["Kept mission not used: mission item 1: LAND needs a waypoint before it to come from"]


class FullDisk(Store):
    """Takes nothing any more once it is full."""

    full = False

    def write(self, name: str, piece: bytes) -> None:
        if self.full:
            raise InputError(f"{name}: No space left on device; old one kept")
        super().write(name, piece)


@pytest.mark.parametrize("plan", HELD)
def test_what_cannot_be_kept_is_not_taken_over(make_flown: Any, place: Place, plan: PlanType, tmp_path: Path) -> None:
    store = FullDisk(tmp_path / "memory")
    vehicle = make_flown(store=store).vehicle
    old = plans(place, vehicle.home)[plan]
    vehicle.load(plan, old)
    store.full = True
    with pytest.raises(InputError, match="No space left"):
        vehicle.load(plan, old[:1])
    assert vehicle.items(plan) == old
    assert make_flown(store=Store(tmp_path / "memory")).vehicle.items(plan) == old


def test_rally_points_and_fences_are_checked(make_flown: Any, place: Place) -> None:
    vehicle = make_flown().vehicle
    with pytest.raises(InputError, match="rally item 0: command 16 is no rally point"):
        vehicle.load(PlanType.RALLY, [place(Command.NAV_WAYPOINT, 0, 0, 80)])
    with pytest.raises(InputError, match="fence item 0: command 16 is none of a fence"):
        vehicle.load(PlanType.FENCE, [place(Command.NAV_WAYPOINT, 0, 0, 80)])


def test_a_mission_in_flight_is_not_exchanged(make_flown: Any, place: Place) -> None:
    flown = make_flown().in_auto(place(Command.NAV_WAYPOINT, 1500, 0, 80))
    flown.fly_s(2)
    with pytest.raises(InputError, match="change to LOITER first"):
        flown.vehicle.load(PlanType.MISSION, (flown.vehicle.home,))
