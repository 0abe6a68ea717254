"""Changing the flight mode by command."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode


def test_every_mode_can_be_asked_for_by_its_number(bench: Any) -> None:
    for mode in Mode:
        assert bench.command(176, 1, mode)[0] == mavlink.MAV_RESULT_ACCEPTED
        assert bench.vehicle.state.mode == mode


def test_unknown_modes_fail_with_the_list_and_others_autopilots_are_denied(bench: Any) -> None:
    result, text = bench.refused(176, 1, 5)
    assert result == mavlink.MAV_RESULT_FAILED
    assert text.startswith("No mode 5: there are MANUAL 0, AUTO 10, RTL 11")
    for params in ((0, 10), (1, math.nan), (math.inf, 10), (1, 10.5)):
        assert bench.command(176, *params)[0] == mavlink.MAV_RESULT_DENIED


def test_the_old_set_mode_has_no_answer(bench: Any) -> None:
    assert bench.tell(mavlink.MAVLink_set_mode_message(3, 1, 10)) == []
    assert bench.vehicle.state.mode == Mode.AUTO
    assert {message.get_type() for message in bench.tell(mavlink.MAVLink_set_mode_message(3, 1, 99))} == {"STATUSTEXT"}


@pytest.mark.parametrize(
    ("command", "params", "mode"),
    [
        (17, (), Mode.LOITER),
        (20, (), Mode.RTL),
        (262, (5,), Mode.RTL),
        (262, (6,), Mode.AUTO),
        (262, (8,), Mode.TAKEOFF),
    ],
)
def test_modes_by_other_names(bench: Any, command: int, params: tuple[float, ...], mode: Mode) -> None:
    assert bench.command(command, *params)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.state.mode == mode


@pytest.mark.parametrize("standard", [0, 1, 99, 5.5, math.nan])
def test_standard_modes_that_are_not_there_are_denied(bench: Any, standard: float) -> None:
    assert bench.command(262, standard)[0] == mavlink.MAV_RESULT_DENIED
