"""What is true of telemetry at the MAVLink boundary: axes, signs, units."""

import math
from typing import Any

import pytest

from missions.frame import LocalFrame
from sitl.services.stream_messages.flight import (
    attitude,
    global_position,
    gps_raw,
    local_position,
    nav_controller_output,
    vfr_hud,
    wind,
)


def test_heading_becomes_clockwise_from_north_and_left_bank_negative_roll(view: Any) -> None:
    message = attitude(view())
    assert message.time_boot_ms == 12520
    assert math.degrees(message.yaw) == pytest.approx(-80)
    assert math.degrees(message.roll) == pytest.approx(-10)
    assert math.degrees(message.pitch) == pytest.approx(5)
    assert message.yawspeed < 0  # turning left
    assert vfr_hud(view()).heading == 280
    assert global_position(view()).hdg == 28000


@pytest.mark.parametrize(("heading_deg", "compass_deg"), [(0, 90), (90, 0), (180, 270), (-90, 180), (90.2, 0)])
def test_the_compass(view: Any, heading_deg: float, compass_deg: int) -> None:
    assert vfr_hud(view(heading=math.radians(heading_deg))).heading == compass_deg


def test_east_north_up_becomes_north_east_down(view: Any) -> None:
    place = global_position(view())
    assert (place.vx, place.vy, place.vz) == (500, -2000, -200)
    assert (place.alt, place.relative_alt) == (1_500_000, 300_000)
    assert (place.lat / 1e7 - 46.5) * 111_150 == pytest.approx(2000, rel=0.01)
    local = local_position(view())
    assert (local.x, local.y, local.z) == (2000.0, 1000.0, -1500.0)
    assert (local.vx, local.vy, local.vz) == (5.0, -20.0, -2.0)
    assert gps_raw(view()).cog == pytest.approx(28404, abs=1)
    assert gps_raw(view()).vel == 2062


def test_wind_is_where_it_comes_from(view: Any) -> None:
    message = wind(view())
    assert message.direction == pytest.approx(-90)  # it blows to the east
    assert (message.speed, message.speed_z) == (pytest.approx(math.hypot(3, 0.5)), -0.5)


def test_errors_are_wanted_minus_actual(view: Any) -> None:
    message = nav_controller_output(view())
    assert (message.alt_error, message.aspd_error, message.xtrack_error) == (6.0, 1.0, 4.0)
    assert message.wp_dist == 0xFFFF


def test_the_target_bearing_points_to_the_current_item(view: Any, frame: LocalFrame) -> None:
    from_home = view(position_m=(*frame.from_e7(465_000_000, 113_000_000), 1200.0))
    message = nav_controller_output(from_home)
    north_m, east_m = 1237e-7 * 111_150, -4321e-7 * 111_320 * math.cos(math.radians(46.5))
    assert message.target_bearing == pytest.approx(math.degrees(math.atan2(east_m, north_m)), abs=1)
