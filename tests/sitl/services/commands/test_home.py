"""Changing where the vehicle returns to."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink


def test_home_is_here_or_there(bench: Any) -> None:
    assert bench.command(179, 1)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.asked[-1] == ("set_home", None)
    assert bench.command_int(179, (0,), (465_123_456, 113_123_456, 20.0), 3)[0] == mavlink.MAV_RESULT_ACCEPTED
    _, home = bench.vehicle.asked[-1]
    assert (home.lat_e7, home.lon_e7, home.alt_m) == (465_123_456, 113_123_456, 1220.0)


def test_a_long_has_degrees_and_metres_above_the_sea(bench: Any) -> None:
    bench.tell(mavlink.MAVLink_command_long_message(3, 1, 179, 0, 0, 0, 0, 0, 46.5, 11.25, 1300.0))
    ((_, home),) = bench.vehicle.asked
    assert (home.lat_e7, home.lon_e7, home.alt_m) == (465_000_000, 112_500_000, 1300.0)


@pytest.mark.parametrize("place", [(95.0, 11.0, 0.0), (46.0, 1e20, 0.0), (math.inf, math.inf, 0.0), (46.0, 11.0, 1e7)])
def test_no_home_is_nowhere(bench: Any, place: tuple[float, ...]) -> None:
    *_, ack = bench.tell(mavlink.MAVLink_command_long_message(3, 1, 179, 0, 0, 0, 0, 0, *place))
    assert ack.result == mavlink.MAV_RESULT_DENIED
    assert bench.command(179, 0.5)[0] == mavlink.MAV_RESULT_DENIED
    assert bench.vehicle.asked == []
