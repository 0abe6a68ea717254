"""Speed, take-off, and flying to a place."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.mission import MissionItem
from sitl.modes import Mode

ACCEPTED, DENIED, FAILED = mavlink.MAV_RESULT_ACCEPTED, mavlink.MAV_RESULT_DENIED, mavlink.MAV_RESULT_FAILED
NAN, INF, SAME = math.nan, math.inf, 2**31 - 1
PLACE = (465_123_456, 113_123_456)


def test_air_and_ground_speed_change(bench: Any) -> None:
    assert bench.command(178, 0, 25.0, -1)[0] == ACCEPTED
    assert bench.vehicle.asked[-1] == ("change_speed", 25.0, False)
    assert bench.command(178, 1, 22.5, -1)[0] == ACCEPTED
    assert bench.vehicle.asked[-1] == ("change_speed", 22.5, True)
    assert bench.command(178, 0, -2, -1)[0] == ACCEPTED
    assert bench.vehicle.asked[-1] == ("change_speed", -2.0, False)
    asked = len(bench.vehicle.asked)
    assert bench.command(178, 0, -1, -1)[0] == ACCEPTED
    assert len(bench.vehicle.asked) == asked
    bench.vehicle.refusal = "slower than it flies"
    assert bench.refused(178, 0, 5.0) == (FAILED, "slower than it flies")


@pytest.mark.parametrize("params", [(2, 25), (NAN, 25), (0, NAN), (0, INF), (0, 0), (0, -3), (0, 25, 60)])
def test_speeds_that_cannot_be_meant_are_denied(bench: Any, params: tuple[float, ...]) -> None:
    assert bench.command(178, *params)[0] == DENIED
    assert bench.vehicle.asked == []


@pytest.mark.parametrize(
    ("z_m", "mav_frame", "above_home_m"),
    [(80.0, 3, 80.0), (80.0, 6, 80.0), (1280.0, 0, 80.0), (0.0, 3, 50.0), (NAN, 3, 50.0)],
)
def test_it_takes_off_to_an_altitude_above_home(bench: Any, z_m: float, mav_frame: int, above_home_m: float) -> None:
    assert bench.command_int(22, (), (0, 0, z_m), mav_frame)[0] == ACCEPTED
    assert bench.vehicle.asked == [("take_off", above_home_m)]


def test_a_take_off_by_long_is_above_home(bench: Any) -> None:
    bench.tell(mavlink.MAVLink_command_long_message(3, 1, 22, 0, 0, 0, 0, NAN, NAN, NAN, 70.0))
    assert bench.vehicle.asked == [("take_off", 70.0)]


@pytest.mark.parametrize(("z_m", "mav_frame"), [(-5.0, 3), (1100.0, 0), (INF, 3), (80.0, 1), (80.0, 10)])
def test_take_offs_into_the_ground_or_in_no_frame_are_denied(bench: Any, z_m: float, mav_frame: int) -> None:
    assert bench.command_int(22, (), (0, 0, z_m), mav_frame)[0] == DENIED
    assert bench.vehicle.asked == []


@pytest.mark.parametrize(
    ("params", "radius_m"),
    [
        ((-1, 1, 0, NAN), 0.0),
        ((-1, 1, 80, NAN), 80.0),
        ((-1, 1, 80, 0), 80.0),
        ((-1, 1, 80, 1), -80.0),
        ((NAN, 1, NAN, 1), -60.0),
    ],
)
def test_it_flies_to_a_place_and_circles_it(bench: Any, params: tuple[float, ...], radius_m: float) -> None:
    assert bench.command_int(192, params, (*PLACE, 150.0), frame=3) == (ACCEPTED, [])
    circle = MissionItem(Command.NAV_LOITER_UNLIM, Frame.GLOBAL, 0, 0, radius_m, 0, *PLACE, alt_m=1350.0)
    assert bench.vehicle.asked == [("reposition", circle)]


@pytest.mark.parametrize("place", [(0, 0, NAN), (SAME, SAME, NAN)])
def test_no_place_is_where_it_is(bench: Any, frame: Any, place: tuple[int, int, float]) -> None:
    bench.vehicle.change(position_m=(400.0, -300.0, 1234.0))
    assert bench.command_int(192, (-1, 1), place, frame=0)[0] == ACCEPTED
    ((_, item),) = bench.vehicle.asked
    assert (item.lat_e7, item.lon_e7, item.alt_m) == (*frame.to_e7(400.0, -300.0), 1234.0)


def test_a_speed_goes_with_it(bench: Any) -> None:
    assert bench.command_int(192, (24, 1), (*PLACE, 150.0))[0] == ACCEPTED
    assert bench.vehicle.asked[-1] == ("change_speed", 24.0, True)


def test_without_the_flag_it_must_be_in_guided(bench: Any) -> None:
    assert bench.command_int(192, (-1, 0), (*PLACE, 150.0))[0] == FAILED
    bench.vehicle.change(mode=Mode.GUIDED)
    assert bench.command_int(192, (-1, 0), (*PLACE, 150.0))[0] == ACCEPTED
    assert len(bench.vehicle.asked) == 1


@pytest.mark.parametrize(
    ("params", "place", "mav_frame"),
    [
        ((-1, 1), (950_000_000, 0, 150.0), 3),
        ((-1, 1), (0, 1_810_000_000, 150.0), 3),
        ((-1, 1), (SAME, 113_000_000, 150.0), 3),
        ((-1, 1), (*PLACE, 1e7), 3),
        ((-1, 1), (*PLACE, INF), 0),
        ((-1, 1), (*PLACE, 150.0), 2),
        ((-1, 1), (*PLACE, 150.0), 10),
        ((-1, INF), (*PLACE, 150.0), 3),
        ((-1, 1, INF), (*PLACE, 150.0), 3),
    ],
)
def test_places_that_are_none_are_denied(bench: Any, params: Any, place: Any, mav_frame: int) -> None:
    assert bench.command_int(192, params, place, mav_frame)[0] == DENIED
    assert bench.vehicle.asked == []


def test_a_place_in_floats_is_refused_as_arduplane_does(bench: Any) -> None:
    long = mavlink.MAVLink_command_long_message(3, 1, 192, 0, -1, 1, 0, 0, 46.5, 11.3, 150.0)
    (ack,) = bench.tell(long)
    assert ack.result == mavlink.MAV_RESULT_COMMAND_INT_ONLY
