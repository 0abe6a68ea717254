"""Missions as written, and that the reference built from them is the schedule they were written for."""

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.reference import build_reference
from missions.scenario import load_scenario
from planner.loiter import Circle
from planner.schedule import even_schedule
from planner.write_mission import ACCEPTANCE_M, write_mission

AIRFRAME = load_scenario("radars").airframe.airframe()
FRAME = LocalFrame(47.0, 8.0, 400.0)
WIND = (2.0, -1.0)
CORNERS = np.array([[0.0, 0, 10], [3000, 0, 200], [6000, 2500, 300], [9000, 2000, 300], [13000, 2000, 250]])
SCHEDULE = even_schedule(CORNERS, 480.0, WIND)
CIRCLE = Circle(13000.0, 2000.0, 290.0, 120.0)


@pytest.fixture
def mission() -> Mission:
    return write_mission(CORNERS, SCHEDULE, CIRCLE, FRAME)


def test_items_come_in_the_order_a_plane_expects(mission: Mission) -> None:
    speed, waypoint = Command.DO_CHANGE_SPEED, Command.NAV_WAYPOINT
    expected = [waypoint, Command.NAV_TAKEOFF, *([speed, waypoint] * 4), Command.NAV_LOITER_UNLIM]
    assert [item.command for item in mission] == expected


def test_altitudes_are_amsl_and_speeds_are_airspeeds(mission: Mission) -> None:
    assert mission.home.alt_m == 410.0
    assert (mission[1].param1, mission[1].alt_m) == (10.0, 440.0)
    assert (mission[1].lat_e7, mission[1].lon_e7) == (mission.home.lat_e7, mission.home.lon_e7)
    for item in mission:
        if item.command == Command.DO_CHANGE_SPEED:
            assert (item.frame, item.param1, item.param3) == (Frame.MISSION, 0.0, -1.0)
        else:
            assert item.frame == Frame.GLOBAL
    told = [item.param2 for item in mission if item.command == Command.DO_CHANGE_SPEED]
    assert told == pytest.approx(SCHEDULE.air_m_s, rel=1e-7)


def test_the_loiter_is_clockwise_around_the_target_at_its_own_altitude(mission: Mission) -> None:
    loiter, target = mission[-1], mission[-2]
    assert (loiter.lat_e7, loiter.lon_e7) == (target.lat_e7, target.lon_e7)
    assert (loiter.param3, loiter.alt_m, target.alt_m) == (120.0, 690.0, 650.0)


def test_acceptance_radii_grow_with_the_turn_and_fit_a_byte(mission: Mission) -> None:
    radii = [item.param2 for item in mission.items[1:] if item.command == Command.NAV_WAYPOINT]
    least, largest = ACCEPTANCE_M
    assert least == radii[3] == radii[2] < radii[0] < radii[1] <= largest  # turns of 0, 10, 40 and 49 degrees


def test_a_speed_that_stays_is_told_once() -> None:
    straight = np.array([[0.0, 0, 100], [4000, 0, 100], [8000, 0, 100]])
    mission = write_mission(straight, even_schedule(straight, 300.0, (0.0, 0.0)), CIRCLE, FRAME)
    assert sum(item.command == Command.DO_CHANGE_SPEED for item in mission) == 1


def test_the_reference_of_the_mission_is_the_schedule_it_was_written_for(mission: Mission) -> None:
    reference = build_reference(mission, FRAME, AIRFRAME, WIND)
    assert reference.duration_s == pytest.approx(480.0, abs=5e-3)
    assert reference.leg_ground_speed_m_s == pytest.approx(SCHEDULE.ground_m_s, rel=1e-4)
    assert np.diff(reference.path.corner_s_m) == pytest.approx(SCHEDULE.arcs_m, abs=0.1)
    assert reference.loiter_z_m == pytest.approx(290.0, abs=1e-3)
    assert reference.points(np.array([0.0]))[0] == pytest.approx(CORNERS[0], abs=0.02)
