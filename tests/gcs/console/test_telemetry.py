"""What vehicles tell of themselves, put into one frame and one time."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.console.telemetry import Telemetry
from gcs.vehicle_link import VehicleLink
from missions.frame import LocalFrame
from sitl.services.peer import Peer

FRAME = LocalFrame(46.5, 11.3, 200.0)


def link_to(sysid: int) -> VehicleLink:
    return VehicleLink(sysid, 1, Peer("udp", "127.0.0.1", 1), lambda message: b"")


class Told:
    """Vehicles that tell where they are, and what becomes of it."""

    def __init__(self, *sysids: int, simulated: bool = True) -> None:
        self.telemetry = Telemetry(FRAME, simulated=simulated)
        self.links = {sysid: link_to(sysid) for sysid in sysids}
        self.listened: list[VehicleLink] = []
        self.telemetry.follow(self.links, self.listened.append)

    def tell(self, sysid: int, boot_s: float, x_m: float = 0.0, y_m: float = 0.0, **changes: Any) -> None:
        lat_e7, lon_e7 = FRAME.to_e7(x_m, y_m)
        values = {"alt": 200_000, "relative_alt": 0, "vx": 0, "vy": 0, "vz": 0, "hdg": 65535}
        values |= {"time_boot_ms": round(boot_s * 1000), "lat": lat_e7, "lon": lon_e7, **changes}
        message = mavlink.MAVLink_global_position_int_message(**values)
        self.telemetry.on_message(sysid, self.links[sysid], message)

    def newest_s(self, sysid: int) -> float:
        return self.telemetry.tracks[sysid].newest_s


@given(st.floats(-5e4, 5e4), st.floats(-5e4, 5e4), st.integers(-500_000, 9_000_000))
def test_positions_land_where_the_frame_says(x_m: float, y_m: float, alt_mm: int) -> None:
    told = Told(1)
    told.tell(1, 10.0, x_m, y_m, alt=alt_mm)
    position, _ = told.telemetry.tracks[1].at(10.0)
    assert position == pytest.approx((x_m, y_m, alt_mm / 1000.0 - FRAME.alt_m), abs=0.02)


def test_velocities_are_turned_from_north_east_down() -> None:
    told = Told(1)
    told.tell(1, 10.0, vx=300, vy=2000, vz=-100)
    before, after = (np.array(told.telemetry.tracks[1].at(t_s)[0]) for t_s in (10.0, 11.0))
    assert after - before == pytest.approx((20.0, 3.0, 1.0))


def test_attitude_is_that_which_was_heard_last_and_without_any_the_heading_is_that_of_the_position() -> None:
    told = Told(1)
    told.tell(1, 1.0, hdg=9000)
    assert told.telemetry.tracks[1].at(1.0)[1] == pytest.approx((0.0, 0.0, 0.0)), "east"
    told.links[1].latest["ATTITUDE"] = mavlink.MAVLink_attitude_message(2000, 0.3, 0.1, math.pi, 0.0, 0.0, 0.0)
    told.tell(1, 2.0, hdg=9000)
    assert told.telemetry.tracks[1].at(2.0)[1] == pytest.approx((0.3, 0.1, -0.5 * math.pi)), "south"


def test_without_a_fix_there_is_no_sample_and_other_messages_are_none() -> None:
    told = Told(1)
    told.tell(1, 1.0, lat=0, lon=0)
    told.telemetry.on_message(1, told.links[1], mavlink.MAVLink_heartbeat_message(1, 3, 0, 10, 4, 3))
    assert told.newest_s(1) == -math.inf


def test_each_vehicle_is_listened_to_once() -> None:
    told = Told(1, 2)
    told.links[3] = link_to(3)
    for _ in range(3):
        told.telemetry.follow(told.links, told.listened.append)
    assert [link.sysid for link in told.listened] == [1, 2, 3]


def test_a_clock_that_has_begun_anew_is_followed_from_its_beginning() -> None:
    told = Told(1)
    for boot_s in (100.0, 101.0, 3.0):
        told.tell(1, boot_s, x_m=boot_s)
    assert told.newest_s(1) == 3.0
    assert told.telemetry.tracks[1].at(3.0)[0][0] == pytest.approx(3.0, abs=0.02)


def test_what_has_been_overtaken_on_its_way_is_left_out() -> None:
    told = Told(1)
    for boot_s in (100.0, 100.5, 100.25):
        told.tell(1, boot_s)
    assert told.newest_s(1) == 100.5


def test_in_a_simulation_all_go_by_one_clock_however_far_apart() -> None:
    told = Told(1, 2)
    told.tell(1, 50.0)
    told.tell(2, 20.0)
    assert (told.newest_s(1), told.newest_s(2)) == (50.0, 20.0)


def test_vehicles_that_booted_at_other_times_come_to_one_time() -> None:
    told = Told(1, 2, 3, simulated=False)
    for second in range(10):
        told.tell(1, 5000.0 + second)
        told.tell(2, 70.0 + second)
        told.tell(3, 5000.3 + second)
        assert told.newest_s(2) == pytest.approx(told.newest_s(1), abs=0.01)
        assert told.newest_s(3) == pytest.approx(told.newest_s(1) + 0.3, abs=0.01), "by one clock, as they say"


def test_who_reboots_among_others_comes_back_to_their_time() -> None:
    told = Told(1, 2, simulated=False)
    for second in range(100, 120):
        told.tell(1, float(second))
        told.tell(2, float(second if second < 110 else second - 105), x_m=float(second))
    assert told.newest_s(2) == pytest.approx(told.newest_s(1), abs=1.1)
    trail = told.telemetry.tracks[2].at(told.newest_s(2))[0]
    assert trail[0] == pytest.approx(119.0, abs=0.02)
