"""Arming and disarming by command."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink


def test_it_arms_and_disarms_or_says_why_not(bench: Any) -> None:
    assert bench.command(400, 1)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.state.armed
    bench.vehicle.change(airborne=True)
    assert bench.refused(400, 0) == (mavlink.MAV_RESULT_FAILED, "in flight")
    assert bench.command(400, 0.5)[0] == mavlink.MAV_RESULT_DENIED


@pytest.mark.parametrize("force", [21196, 2989])
def test_force_arms_without_a_mission_and_disarms_in_the_air(bench: Any, make_mission: Any, force: int) -> None:
    bench.vehicle.mission = make_mission(1)
    assert bench.command(400, 1)[0] == mavlink.MAV_RESULT_FAILED
    assert bench.command(400, 1, force)[0] == mavlink.MAV_RESULT_ACCEPTED
    bench.vehicle.change(airborne=True)
    assert bench.command(400, 0, force)[0] == mavlink.MAV_RESULT_ACCEPTED


def test_the_checks_are_run_without_arming(bench: Any, make_mission: Any) -> None:
    assert bench.command(401) == (mavlink.MAV_RESULT_ACCEPTED, [])
    bench.vehicle.mission = make_mission(1)
    assert bench.refused(401) == (mavlink.MAV_RESULT_ACCEPTED, "no mission: upload one first")
    assert not bench.vehicle.state.armed
    bench.vehicle.change(armed=True)
    assert bench.command(401)[0] == mavlink.MAV_RESULT_TEMPORARILY_REJECTED
