"""Modes and commands in flight and on the ground: what is done, and what is refused with a reason."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.environment.terrain import ground_heights_m
from missions.mission import MissionItem
from missions.plan_type import PlanType
from missions.scenario import load_scenario
from sitl.config import VehicleConfig
from sitl.modes import Mode
from sitl.swarm import SwarmOptions, vehicle_configs

Place = Callable[..., MissionItem]


def test_take_off_goes_into_the_wind_and_then_circles(make_flown: Any) -> None:
    flown = make_flown()
    assert flown.vehicle.take_off(80.0) == "Take-off refused: not armed"
    assert flown.vehicle.arm() is None
    assert flown.vehicle.take_off(80.0) is None
    rows = flown.fly_s(100)
    east, north = flown.vehicle._config.steady_wind_m_s
    assert rows[100, 0] * east + rows[100, 1] * north < 0
    assert rows[-500:, 2] == pytest.approx(80, abs=5)
    assert flown.texts == ["Launched", "Take-off complete, circling"]
    assert flown.vehicle.take_off(90.0) == "Already flying"


def test_mode_takeoff_launches_once_armed(make_flown: Any) -> None:
    flown = make_flown()
    assert flown.vehicle.set_mode(Mode.TAKEOFF) is None
    flown.fly_s(1)
    assert not flown.vehicle.airborne
    assert flown.vehicle.arm() is None
    rows = flown.fly_s(60)
    assert rows[-1, 2] == pytest.approx(flown.vehicle.parameters["TKOFF_ALT"], abs=6)


def test_guided_flies_straight_there_and_circles(make_flown: Any, place: Place) -> None:
    flown = make_flown().taken_off()
    assert flown.vehicle.reposition(place(Command.NAV_LOITER_UNLIM, 3000, 1000, 150, param3=-300)) is None
    assert flown.vehicle.snapshot().mode == Mode.GUIDED
    rows = flown.fly_s(300)
    assert np.hypot(rows[-900:, 0] - 3000, rows[-900:, 1] - 1000) == pytest.approx(300, abs=25)
    assert rows[-900:, 2] == pytest.approx(150, abs=6)
    turning = np.unwrap(np.arctan2(rows[-900:, 1] - 1000, rows[-900:, 0] - 3000))
    assert turning[-1] > turning[0], "a negative radius turns anticlockwise"


def test_rtl_comes_home_or_to_the_nearest_rally_point(make_flown: Any, place: Place) -> None:
    flown = make_flown().taken_off()
    rally = place(Command.NAV_RALLY_POINT, 2500, 0, 120)
    flown.vehicle.load(PlanType.RALLY, [place(Command.NAV_RALLY_POINT, 0, 9000, 90), rally])
    flown.vehicle.reposition(place(Command.NAV_LOITER_UNLIM, 3000, 1500, 150))
    flown.fly_s(150)
    assert flown.vehicle.set_mode(Mode.RTL) is None
    rows = flown.fly_s(150)
    assert np.hypot(rows[-1, 0] - 2500, rows[-1, 1]) == pytest.approx(283, abs=30)
    assert rows[-1, 2] == pytest.approx(120, abs=6)
    flown.vehicle.load(PlanType.RALLY, [])
    assert flown.vehicle.parameters["RALLY_TOTAL"] == 0
    flown.vehicle.parameters.set("RTL_ALTITUDE", -1)
    flown.vehicle.set_mode(Mode.LOITER)
    flown.vehicle.set_mode(Mode.RTL)
    rows = flown.fly_s(250)
    assert np.hypot(*rows[-1, :2]) == pytest.approx(283, abs=30)
    assert rows[-1, 2] == pytest.approx(120, abs=8)


def test_rtl_over_a_mountain_climbs_and_says_so(make_flown: Any) -> None:
    config = vehicle_configs(load_scenario("mountains"), SwarmOptions(seed=1, delay_s=0.2))[0]
    flown = make_flown(replace(config, home_m=(3000.0, 30000.0, 95.0))).taken_off()
    lat_e7, lon_e7 = config.frame.to_e7(17000.0, 30000.0)
    there = MissionItem(Command.NAV_LOITER_UNLIM, 3, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=100)
    assert flown.vehicle.reposition(there) is None
    rows = flown.fly_s(1000)
    assert any(text.startswith("Terrain ahead: climbing to ") for text in flown.texts)
    assert rows[-1, :2] == pytest.approx((17000, 30000), abs=400)
    above = rows[:, 2] - ground_heights_m(rows[:, 0], rows[:, 1], config.terrain)
    assert rows[:, 2].max() > 1900
    assert above.min() > 15


@pytest.mark.parametrize("mode", [Mode.RTL, Mode.LOITER, Mode.GUIDED])
def test_modes_of_flight_are_refused_on_the_ground(make_flown: Any, mode: Mode) -> None:
    assert make_flown().vehicle.set_mode(mode) == "not flying"


def test_speed_is_changed_within_what_is_set(make_flown: Any) -> None:
    flown = make_flown()
    assert flown.vehicle.change_speed(25.0, over_ground=False) == "Not flying"
    flown.taken_off()
    assert "is not within AIRSPEED_MIN 18" in flown.vehicle.change_speed(45.0, over_ground=False)
    assert flown.vehicle.change_speed(22.0, over_ground=False) is None
    assert flown.fly_s(60)[-300:, 3].mean() == pytest.approx(22.0, abs=1.0)
    assert flown.vehicle.change_speed(24.0, over_ground=True) is None
    flown.fly_s(60)
    speeds = []
    for _ in range(50):
        flown.fly_s(1)
        speeds.append(np.hypot(*flown.vehicle.snapshot().ground_velocity_m_s[:2]))
    assert np.mean(speeds) == pytest.approx(24.0, abs=1.5)
    assert flown.vehicle.change_speed(-2.0, over_ground=False) is None
    assert flown.fly_s(60)[-300:, 3].mean() == pytest.approx(28.0, abs=1.0)


def test_another_speed_in_auto_leaves_the_formation_until_it_is_over(make_flown: Any, straight_mission: Any) -> None:
    flown = make_flown().in_auto(*straight_mission.items[1:])
    flown.fly_s(20)
    assert flown.vehicle.snapshot().in_formation
    flown.vehicle.change_speed(24.0, over_ground=False)
    flown.fly_s(20)
    assert not flown.vehicle.observe().in_formation
    flown.vehicle.change_speed(-2.0, over_ground=False)
    flown.fly_s(1)
    assert flown.vehicle.snapshot().in_formation
    assert abs(flown.vehicle.snapshot().along_track_m) < 10


def test_home_moves_with_the_mission_and_what_is_relative_to_it(make_flown: Any, place: Place) -> None:
    flown = make_flown()
    flown.vehicle.load(PlanType.MISSION, (flown.vehicle.home, place(Command.NAV_WAYPOINT, 1500, 0, 80)))
    there = replace(place(Command.NAV_WAYPOINT, 300, 400, 450), frame=Frame.GLOBAL)
    assert flown.vehicle.set_home(there) is None
    assert flown.vehicle.mission.home == flown.vehicle.home
    assert flown.vehicle.snapshot().home_m == pytest.approx((300, 400, 0), abs=0.1)
    assert flown.vehicle.snapshot().position_m[0] == pytest.approx(0, abs=0.1)
    assert flown.vehicle.set_home(None) is None
    assert flown.vehicle.snapshot().home_m == pytest.approx((0, 0, 0), abs=0.1)
    assert "away" in flown.vehicle.set_home(place(Command.NAV_WAYPOINT, 2e6, 0, 0))


def test_start_mission_begins_with_the_first_item(make_flown: Any, place: Place) -> None:
    flown = make_flown()
    assert flown.vehicle.start_mission() == "not armed"
    assert flown.vehicle.arm() is None
    assert flown.vehicle.start_mission() == "no mission to fly"
    way = [place(Command.NAV_WAYPOINT, x, y, 80) for x, y in ((1200, 0), (1200, 1500))]
    flown.vehicle.load(PlanType.MISSION, (flown.vehicle.home, *way))
    assert flown.vehicle.start_mission() is None
    flown.fly_s(70)
    assert flown.vehicle.start_mission() is None
    flown.fly_s(100)
    assert flown.reached[:2] == [1, 1]


def test_disarmed_by_force_it_glides_to_the_ground_and_can_be_saved(make_flown: Any, config: VehicleConfig) -> None:
    flown = make_flown().taken_off(150.0)
    assert flown.vehicle.disarm() == "flying"
    assert flown.vehicle.disarm(force=True) is None
    rows = flown.fly_s(30)
    assert rows[-1, 2] < rows[0, 2] - 20
    assert rows[:, 3].min() > config.airframe.airspeed_min_m_s
    assert flown.vehicle.set_mode(Mode.RTL) == "RTL refused: engine off"
    assert flown.vehicle.arm() == "Gliding with the engine off: arm by force"
    assert flown.vehicle.arm(force=True) is None
    rows = flown.fly_s(30)
    assert rows[-1, 2] > rows[0, 2] - 15
    assert flown.vehicle.disarm(force=True) is None
    rows = flown.fly_s(120)
    assert flown.texts[-2:] == ["Touchdown", "Landed and disarmed"]
    assert rows[-1, 3] == 0.0
