"""Modes by the numbers of both autopilots."""

import pytest

from gcs.flight_modes import custom_mode, mode_name, mode_params
from missions.autopilot import Autopilot
from missions.errors import InputError
from sitl.modes import Mode


@pytest.mark.parametrize("autopilot", Autopilot)
def test_each_mode_is_known_again_by_its_number(autopilot: Autopilot) -> None:
    modes = set(Mode) - ({Mode.GUIDED} if autopilot is Autopilot.px4 else set())
    assert {mode_name(custom_mode(mode, autopilot), autopilot) for mode in modes} == {mode.name for mode in modes}


def test_the_numbers_are_those_that_stations_show() -> None:
    assert custom_mode(Mode.AUTO, Autopilot.px4) == 0x04040000  # main mode AUTO, sub mode MISSION
    assert mode_params(Mode.RTL, Autopilot.px4) == (4.0, 5.0)
    assert mode_params(Mode.RTL, Autopilot.ardupilot) == (11.0, 0.0)


def test_a_mode_that_skein_does_not_use_has_its_number_for_a_name() -> None:
    assert mode_name(5, Autopilot.ardupilot) == "mode 5"  # ArduPlane's FBWA
    assert mode_name(0x00080000, Autopilot.px4) == "mode 524288"


def test_px4_has_no_mode_guided() -> None:
    with pytest.raises(InputError, match="PX4 has no mode GUIDED; it has MANUAL, TAKEOFF, LOITER, AUTO, RTL"):
        custom_mode(Mode.GUIDED, Autopilot.px4)
