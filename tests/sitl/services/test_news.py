"""What changes is told at once, and once."""

from dataclasses import replace
from typing import Any

import pytest

from sitl.modes import Mode
from sitl.snapshot import LandedState


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"mode": Mode.RTL}, ["HEARTBEAT", "CURRENT_MODE"]),
        ({"armed": True}, ["HEARTBEAT"]),
        ({"failsafe": True}, ["HEARTBEAT"]),
        ({"landed": LandedState.TAKING_OFF}, ["EXTENDED_SYS_STATE"]),
        ({"breach_status": True}, ["FENCE_STATUS"]),
        ({"current_seq": 3}, ["MISSION_CURRENT"]),
        ({"time_s": 5.0, "position_m": (1.0, 2.0, 3.0)}, []),
    ],
)
def test_changes_of_state(bench: Any, changes: dict[str, Any], told: list[str]) -> None:
    bench.tick()
    bench.vehicle.change(**changes)
    assert [message.get_type() for message in bench.tick(0.2)] == told
    assert bench.tick(0.2) == []


def test_a_new_home_and_a_new_mission(bench: Any, make_mission: Any) -> None:
    bench.tick()
    bench.vehicle.home = replace(bench.vehicle.home, lat_e7=465_000_001)
    (home,) = bench.tick(0.2)
    assert (home.get_type(), home.latitude) == ("HOME_POSITION", 465_000_001)
    bench.vehicle.mission = make_mission(4)
    (current,) = bench.tick(0.2)
    assert (current.get_type(), current.total) == ("MISSION_CURRENT", 3)
