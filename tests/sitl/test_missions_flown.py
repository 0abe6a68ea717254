"""Every kind of mission item, flown: what a pilot would see."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from missions.commands import Command
from missions.mission import MissionItem
from sitl.config import VehicleConfig
from sitl.modes import Mode
from sitl.snapshot import LandedState

Place = Callable[..., MissionItem]


@pytest.fixture
def calm(config: VehicleConfig) -> VehicleConfig:
    return replace(config, gusts="none", steady_wind_m_s=(0.0, 0.0), forecast_wind_m_s=(0.0, 0.0))


def turns_about(rows: np.ndarray, x: float, y: float) -> float:
    """Turns anticlockwise."""
    return float(np.ptp(np.unwrap(np.arctan2(rows[:, 1] - y, rows[:, 0] - x)))) / (2 * np.pi)


def test_a_racetrack_is_flown_as_often_as_its_jump_says(make_flown: Any, place: Place) -> None:
    way = [place(Command.NAV_WAYPOINT, x, y, 100) for x, y in ((1200, 0), (1200, 1200), (0, 1200), (0, 300))]
    flown = make_flown().in_auto(place(Command.NAV_TAKEOFF, z=40), *way, place(Command.DO_JUMP, param1=2, param2=2))
    rows = flown.fly_s(650)
    assert flown.reached == [1, *[2, 3, 4, 5] * 3]
    assert "Mission complete, loitering" in flown.texts
    inside = rows[2000 : round(400 / 0.04)]
    assert inside[:, :2].min() > -60
    assert inside[:, :2].max() < 1260


def test_a_jump_for_ever_is_flown_for_ever(make_flown: Any, place: Place) -> None:
    way = [place(Command.NAV_WAYPOINT, x, y, 100) for x, y in ((900, 0), (900, 900), (0, 900), (0, 200))]
    flown = make_flown().in_auto(*way, place(Command.DO_JUMP, param1=1, param2=-1))
    flown.fly_s(3000)
    assert flown.reached[:6] == [1, 2, 3, 4, 1, 2]
    assert len(flown.reached) > 70
    assert not flown.vehicle.snapshot().mission_complete


def test_a_jump_back_to_a_loiter_of_no_time_reaches_it_once_a_second(make_flown: Any, place: Place) -> None:
    loiter = place(Command.NAV_LOITER_TIME, 900, 0, 100)
    flown = make_flown().in_auto(loiter, place(Command.DO_JUMP, param1=1, param2=-1))
    flown.fly_s(100)
    assert 30 < len(flown.reached) <= 100
    assert set(flown.reached) == {1}


@pytest.mark.parametrize(
    ("command", "params", "seconds"),
    [
        (Command.NAV_LOITER_TIME, {"param1": 90}, 90),
        (Command.NAV_LOITER_TURNS, {"param1": 2}, 2 * 2 * np.pi * 250 / 28),
    ],
)
def test_a_loiter_lasts_as_long_as_it_says(
    make_flown: Any, place: Place, calm: VehicleConfig, command: int, params: dict[str, float], seconds: float
) -> None:
    loiter = place(command, 2000, 0, 120, param3=-250, **params)
    flown = make_flown(calm).in_auto(
        place(Command.NAV_WAYPOINT, 1000, 0, 100), loiter, place(Command.NAV_WAYPOINT, 4000, 0, 120)
    )
    rows = flown.fly_s(400)
    assert flown.reached == [1, 2, 3]
    on_circle = np.abs(np.hypot(rows[:, 0] - 2000, rows[:, 1]) - 250) < 75
    assert on_circle.sum() * 0.04 == pytest.approx(seconds, abs=25)
    circling = rows[on_circle]
    assert np.hypot(circling[500:-500, 0] - 2000, circling[500:-500, 1]) == pytest.approx(250, abs=12)
    assert circling[1000:-200, 2] == pytest.approx(120, abs=3)


def test_loiter_to_altitude_ends_at_the_altitude(make_flown: Any, place: Place, calm: VehicleConfig) -> None:
    down = place(Command.NAV_LOITER_TO_ALT, 1500, 1500, 60, param2=220)
    flown = make_flown(calm).in_auto(
        place(Command.NAV_WAYPOINT, 1500, 0, 200), down, place(Command.NAV_WAYPOINT, -1500, 1500, 60)
    )
    rows = flown.fly_s(330)
    assert flown.reached == [1, 2, 3]
    left_at = np.argmax(rows[1500:, 0] < 1000) + 1500
    assert rows[left_at, 2] == pytest.approx(60, abs=8)


def test_it_turns_right_round_where_the_path_does(make_flown: Any, place: Place) -> None:
    there_and_back = [place(Command.NAV_WAYPOINT, x, 0, 100) for x in (2000, 200, 2000)]
    flown = make_flown().in_auto(*there_and_back)
    rows = flown.fly_s(300)
    assert flown.reached == [1, 2, 3]
    assert np.abs(rows[:, 1]).max() < 500
    assert rows[:, 3].min() > 18


def test_it_lands_where_it_should_and_disarms(make_flown: Any, place: Place) -> None:
    flown = make_flown().in_auto(
        place(Command.NAV_TAKEOFF, z=50),
        place(Command.NAV_WAYPOINT, 1500, 0, 80),
        place(Command.NAV_WAYPOINT, 1500, 1500, 80),
        place(Command.NAV_WAYPOINT, 700, 1500, 50),
        place(Command.NAV_LAND, -200, 1500, 0),
    )
    states = []
    for _ in range(14000):
        flown.vehicle.observe()
        states.append(flown.vehicle.snapshot().landed)
        flown.vehicle.advance({})
        if not flown.vehicle.snapshot().armed:
            break
    flown.hear()
    rows = flown.rows()
    assert [state for i, state in enumerate(states) if i == 0 or state != states[i - 1]] == [
        LandedState.TAKING_OFF,
        LandedState.IN_AIR,
        LandedState.LANDING,
        LandedState.ON_GROUND,
    ]
    touchdown = states.index(LandedState.ON_GROUND)
    assert rows[touchdown, :3] == pytest.approx((-200, 1500, 0), abs=100)
    assert abs(rows[touchdown - 1, 2] - rows[touchdown - 2, 2]) / 0.04 < 1.5, "sink at touchdown"
    assert flown.vehicle.snapshot().airspeed_m_s == 0.0
    assert rows[:, 2].min() >= 0.0
    assert flown.reached == [1, 2, 3, 4, 5]
    assert flown.texts == ["Launched", "Touchdown", "Landed and disarmed"]
    assert not flown.vehicle.airborne
    assert flown.vehicle.snapshot().mission_complete


def test_after_a_landing_it_takes_off_again_from_where_it_stopped(make_flown: Any, place: Place) -> None:
    flown = make_flown().in_auto(place(Command.NAV_WAYPOINT, 1200, 0, 50), place(Command.NAV_LAND, 2000, 0, 0))
    flown.fly_s(120)
    assert not flown.vehicle.airborne
    assert flown.vehicle.arm() is None
    flown.fly_s(5)
    assert flown.vehicle.airborne
    assert flown.vehicle.snapshot().position_m[0] > 1800


def test_return_to_launch_ends_the_mission_at_home(make_flown: Any, place: Place) -> None:
    back = place(Command.NAV_RETURN_TO_LAUNCH)
    flown = make_flown().in_auto(place(Command.NAV_WAYPOINT, 2000, 500, 60), back)
    rows = flown.fly_s(330)
    assert "Mission complete, flying home" in flown.texts
    radius = flown.vehicle.parameters["WP_LOITER_RAD"]
    assert np.hypot(rows[-1000:, 0], rows[-1000:, 1]) == pytest.approx(radius, abs=25)
    assert rows[-1000:, 2] == pytest.approx(flown.vehicle.parameters["RTL_ALTITUDE"], abs=6)
    assert flown.vehicle.snapshot().mission_complete


def test_a_loiter_without_a_waypoint_begins_with_a_climb_towards_it(make_flown: Any, place: Place) -> None:
    flown = make_flown().in_auto(
        place(Command.NAV_TAKEOFF, z=60), place(Command.NAV_LOITER_TURNS, 0, 1500, 80, param1=1)
    )
    rows = flown.fly_s(200)
    assert flown.reached == [1, 2]
    assert abs(rows[100, 0]) < 20 < rows[100, 1], "northwards"


def test_set_current_goes_on_with_that_item(make_flown: Any, place: Place) -> None:
    way = [place(Command.NAV_WAYPOINT, x, y, 80) for x, y in ((1500, 0), (3000, 0), (3000, 1500))]
    flown = make_flown().in_auto(*way)
    flown.fly_s(20)
    assert flown.vehicle.set_current(3) is None
    assert flown.vehicle.snapshot().current_seq == 3
    flown.fly_s(150)
    assert flown.reached == [3]
    assert flown.vehicle.set_current(9) == "No item 9: the mission has 3"


def test_a_landing_sequence_asked_for_from_afar_comes_in_by_its_waypoint(make_flown: Any, place: Place) -> None:
    flown = make_flown().in_auto(
        place(Command.NAV_WAYPOINT, 3000, 0, 150),
        place(Command.NAV_LOITER_UNLIM, 3000, 0, 150),
        place(Command.DO_LAND_START),
        place(Command.NAV_LOITER_TO_ALT, -1500, 0, 50),
        place(Command.NAV_LAND, -500, 0, 0),
    )
    flown.vehicle.parameters.set("RTL_AUTOLAND", 2)
    flown.fly_s(60)
    assert flown.vehicle.set_mode(Mode.RTL) is None
    assert flown.vehicle.snapshot().mode == Mode.AUTO
    flown.fly_s(400)
    assert flown.texts[-1] == "Landed and disarmed"
    assert flown.vehicle.snapshot().position_m[:2] == pytest.approx((-500, 0), abs=200)
    assert flown.reached == [4, 5]


def test_leaving_and_coming_back_goes_on_with_the_same_item(make_flown: Any, place: Place) -> None:
    way = [place(Command.NAV_WAYPOINT, x, y, 80) for x, y in ((1200, 0), (1200, 1500), (0, 1500))]
    flown = make_flown().in_auto(*way)
    flown.fly_s(60)
    assert flown.vehicle.set_mode(Mode.LOITER) is None
    flown.fly_s(100)
    assert flown.vehicle.set_mode(Mode.AUTO) is None
    flown.fly_s(200)
    assert flown.reached == [1, 2, 3]


def test_with_mis_restart_it_begins_anew(make_flown: Any, place: Place) -> None:
    way = [place(Command.NAV_WAYPOINT, x, y, 80) for x, y in ((1200, 0), (1200, 1500), (0, 1500))]
    flown = make_flown().in_auto(*way)
    flown.vehicle.parameters.set("MIS_RESTART", 1)
    flown.fly_s(60)
    flown.vehicle.set_mode(Mode.LOITER)
    flown.fly_s(10)
    flown.vehicle.set_mode(Mode.AUTO)
    flown.fly_s(150)
    assert flown.reached[:3] == [1, 1, 2]


def test_the_same_flight_twice_is_the_same_bit_for_bit(make_flown: Any, place: Place) -> None:
    items = [
        place(Command.NAV_WAYPOINT, 900, 0, 60),
        place(Command.NAV_LOITER_TURNS, 900, 900, 80, param1=1),
        place(Command.NAV_WAYPOINT, 0, 900, 60),
        place(Command.NAV_WAYPOINT, -800, 900, 40),
        place(Command.NAV_LAND, -1600, 900, 0),
    ]
    one, other = (make_flown().in_auto(*items).fly_s(250) for _ in range(2))
    assert (one == other).all()
