"""What is true of telemetry at the MAVLink boundary: axes, signs, units."""

import math
from typing import Any

import pytest

from missions.frame import LocalFrame
from sitl.modes import Mode
from sitl.services.codec import Codec
from sitl.services.stream_messages import (
    BUILDERS,
    View,
    attitude,
    global_position,
    gps_raw,
    home_position,
    local_position,
    mission_current,
    nav_controller_output,
    vfr_hud,
    wind,
)


@pytest.fixture
def view(make_vehicle: Any, make_mission: Any, frame: LocalFrame) -> Any:
    """Makes views of a vehicle that flies west and a little north, in a left turn, climbing."""

    def make(**changes: Any) -> View:
        vehicle = make_vehicle(1)
        vehicle.change(
            time_s=12.52,
            mode=Mode.AUTO,
            armed=True,
            airborne=True,
            position_m=(1000.0, 2000.0, 1500.0),
            ground_velocity_m_s=(-20.0, 5.0, 2.0),
            airspeed_m_s=22.0,
            climb_angle=math.radians(5),
            heading=math.radians(170),
            bank=math.radians(10),
            thrust_fraction=0.6,
            wind_m_s=(3.0, 0.0, 0.5),
            airspeed_wanted_m_s=23.0,
            current_seq=1,
            cross_track_m=4.0,
            altitude_error_m=-6.0,
            distance_to_waypoint_m=70_000.0,
        )
        vehicle.change(**changes)
        return View(vehicle.snapshot(), frame, make_mission(5), 77)

    return make


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


def test_home_is_where_item_0_is(view: Any) -> None:
    message = home_position(view())
    assert (message.latitude, message.longitude, message.altitude) == (465_000_000, 113_000_000, 1_200_000)
    assert (message.x, message.y, message.z) == (pytest.approx(0, abs=1e-6), pytest.approx(0, abs=1e-6), -1200.0)


@pytest.mark.parametrize(
    ("changes", "state"),
    [({}, 3), ({"mode": Mode.LOITER}, 4), ({"airborne": False}, 2), ({"mission_complete": True}, 5)],
)
def test_the_missions_state(view: Any, changes: dict[str, Any], state: int) -> None:
    message = mission_current(view(**changes))
    assert (message.seq, message.total, message.opaque_id, message.mission_state) == (1, 4, 77, state)


def test_every_message_can_be_encoded(view: Any) -> None:
    codec, reader = Codec(1, 1), Codec(255, 190)
    far = view(ground_velocity_m_s=(900.0, 0.0, -400.0), thrust_fraction=1.7, distance_to_waypoint_m=-3.0)
    for message_id, build in BUILDERS.items():
        assert [read.get_msgId() for read in reader.feed(codec.pack(build(far)))] == [message_id]
