"""A vehicle in flight: it launches, keeps its path and schedule, reports what it reaches, loiters, and obeys."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from missions.errors import InputError
from missions.mission import Mission
from missions.plan_type import PlanType
from sitl.config import VehicleConfig
from sitl.events import ItemReached
from sitl.formation.correction import Correction
from sitl.modes import Mode
from sitl.ticks import TICK_S

MakeFlown = Callable[..., Any]
ARRIVED_TICKS = round(130 / TICK_S)
"""Long after the straight mission's end at some 107 s."""


def airborne(flown: Any, mission: Mission) -> Any:
    flown.vehicle.load(PlanType.MISSION, mission.items)
    assert flown.vehicle.arm() is None
    assert flown.vehicle.set_mode(Mode.AUTO) is None
    return flown


def test_it_stays_on_its_launcher_until_armed_in_auto(make_flown: MakeFlown, straight_mission: Mission) -> None:
    flown = make_flown()
    flown.vehicle.load(PlanType.MISSION, straight_mission.items)
    flown.fly(50)
    assert not flown.vehicle.airborne
    assert (flown.rows() == flown.rows()[0]).all()


def test_it_is_launched_at_tick_0_at_the_scheduled_ground_speed(
    make_flown: MakeFlown, straight_mission: Mission
) -> None:
    flown = airborne(make_flown(), straight_mission)
    flown.fly(2)
    rows = flown.rows()
    forecast_ground_speed = 28 - 1.5  # headwind of 1.5 m/s forecast, crosswind and climb take little
    assert (rows[1, 0] - rows[0, 0]) / TICK_S == pytest.approx(forecast_ground_speed, abs=0.2)


@pytest.mark.parametrize("arm", ["full", "own_schedule", "plain"])
def test_it_keeps_near_its_path_and_reaches_its_items_in_order(
    make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission, arm: str
) -> None:
    flown = airborne(make_flown(replace(config, arm=arm)), straight_mission)
    reached = []
    for _ in range(ARRIVED_TICKS):
        flown.fly(1)
        reached += [event.seq for event in flown.vehicle.drain_events() if isinstance(event, ItemReached)]
    assert reached == [1, 3, 4]
    snapshot = flown.vehicle.snapshot()
    assert snapshot.mission_complete
    assert snapshot.current_seq == 5
    rows = flown.rows()
    on_path = rows[rows[:, 0] < 3000][:, :3]
    assert np.abs(on_path[:, 1]).max() < 8, "cross-track, metres"
    planned_z = np.minimum(on_path[:, 0] * 90 / 1500, 90)
    assert np.abs(on_path[:, 2] - planned_z).max() < 8


def test_it_arrives_on_schedule_in_wind_that_nobody_forecast(make_flown: MakeFlown, straight_mission: Mission) -> None:
    flown = airborne(make_flown(), straight_mission)
    planned_s = flown.vehicle._captain.itinerary.first_stage.reference.duration_s
    flown.fly(ARRIVED_TICKS)
    arrival_s = np.argmax(flown.rows()[:, 0] >= 3000) * TICK_S
    assert arrival_s == pytest.approx(planned_s, abs=1.0)


def test_a_plain_autopilot_is_late_in_that_wind(
    make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission
) -> None:
    flown = airborne(make_flown(replace(config, arm="plain", gusts="none")), straight_mission)
    planned_s = flown.vehicle._captain.itinerary.first_stage.reference.duration_s
    flown.fly(ARRIVED_TICKS)
    assert np.argmax(flown.rows()[:, 0] >= 3000) * TICK_S > planned_s + 4


def test_in_flight_every_limit_holds(make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission) -> None:
    airframe = config.airframe
    flown = airborne(make_flown(replace(config, gusts="moderate")), straight_mission)
    for _ in range(ARRIVED_TICKS):
        flown.fly(1)
        controls = flown.vehicle._pilot.flight.controls
        assert 0 <= controls.thrust <= airframe.static_thrust_n
        assert 0 <= controls.lift <= airframe.load_factor_max * airframe.mass_kg * 9.81
        assert abs(controls.bank) <= airframe.bank_max
    rows = flown.rows()
    assert rows[:, 3].min() > airframe.airspeed_min_m_s
    assert rows[:, 3].max() < airframe.airspeed_max_m_s + 1
    climb = np.diff(rows[:, 2]) / TICK_S
    assert climb.min() > airframe.climb_rate_min_m_s - 1
    assert climb.max() < airframe.climb_rate_max_m_s + 1


def test_after_the_mission_it_circles_the_target_at_the_stacked_altitude(
    make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission
) -> None:
    flown = airborne(make_flown(replace(config, gusts="none", steady_wind_m_s=(0.0, 0.0))), straight_mission)
    flown.fly(ARRIVED_TICKS + round(200 / TICK_S))
    last = flown.rows()[-1000:]
    assert np.hypot(last[:, 0] - 3000, last[:, 1]) == pytest.approx(250, abs=15)
    assert last[:, 2] == pytest.approx(130, abs=2)
    turning = np.unwrap(np.arctan2(last[:, 1], last[:, 0] - 3000))
    assert turning[-1] < turning[0], "a positive radius turns clockwise"


def test_a_late_neighbour_slows_it_down_and_only_with_corrections(
    make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission
) -> None:
    neighbour = config.network.neighbours(config.sysid)[0]

    def late(tick: int) -> dict[int, Correction]:
        return {neighbour: Correction(neighbour, tick - 5, tick, True, -20.0, 0.0)}

    places = {}
    for arm in ("full", "own_schedule"):
        for name, heard in (("alone", lambda tick: {}), ("late", late)):
            flown = airborne(make_flown(replace(config, arm=arm)), straight_mission)
            flown.fly(750, heard)
            places[arm, name] = flown.rows()[-1, 0]
    assert places["full", "late"] < places["full", "alone"] - 3
    assert places["own_schedule", "late"] == places["own_schedule", "alone"]


def test_a_neighbour_that_does_not_fly_its_schedule_is_not_followed(
    make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission
) -> None:
    neighbour = config.network.neighbours(config.sysid)[0]
    on_ground, nobody = airborne(make_flown(), straight_mission), airborne(make_flown(), straight_mission)
    on_ground.fly(300, lambda tick: {neighbour: Correction(neighbour, tick - 5, tick, False, -999.0, 0.0)})
    nobody.fly(300)
    assert (on_ground.rows() == nobody.rows()).all()


def test_loiter_and_back_to_the_mission(make_flown: MakeFlown, straight_mission: Mission) -> None:
    flown = airborne(make_flown(), straight_mission)
    flown.fly(1000)
    assert flown.vehicle.set_mode(Mode.LOITER) is None
    flown.fly(2000)
    circling = flown.vehicle.snapshot()
    assert np.hypot(circling.position_m[0] - 1060, circling.position_m[1]) < 700
    assert flown.vehicle.set_mode(Mode.AUTO) is None
    flown.fly(ARRIVED_TICKS)
    assert flown.vehicle.snapshot().mission_complete


def test_a_station_may_change_the_mode_between_the_halves_of_a_tick(
    make_flown: MakeFlown, straight_mission: Mission
) -> None:
    flown = airborne(make_flown(), straight_mission)
    flown.fly(1000)
    for mode in (Mode.LOITER, Mode.AUTO, Mode.RTL, Mode.AUTO):
        flown.vehicle.observe()
        assert flown.vehicle.set_mode(mode) is None
        flown.vehicle.advance({})
        flown.fly(50)
    assert flown.vehicle.airborne


@pytest.mark.parametrize(("mode", "reason"), [(Mode.AUTO, "no mission to fly"), (Mode.LOITER, "not flying")])
def test_modes_that_make_no_sense_on_the_ground_are_refused(make_flown: MakeFlown, mode: Mode, reason: str) -> None:
    assert make_flown().vehicle.set_mode(mode) == reason


def test_nobody_disarms_it_in_flight(make_flown: MakeFlown, straight_mission: Mission) -> None:
    flown = airborne(make_flown(), straight_mission)
    flown.fly(10)
    assert flown.vehicle.disarm() == "flying"
    assert flown.vehicle.set_mode(Mode.MANUAL) == "nobody at the sticks"


def test_a_mission_that_cannot_be_flown_leaves_the_old_one(make_flown: MakeFlown, straight_mission: Mission) -> None:
    vehicle = make_flown().vehicle
    vehicle.load(PlanType.MISSION, straight_mission.items)
    nowhere = Mission((straight_mission[0], straight_mission[0]))
    with pytest.raises(InputError):
        vehicle.load(PlanType.MISSION, nowhere.items)
    assert vehicle.mission == straight_mission


def test_the_same_seed_flies_the_same_and_another_does_not(
    make_flown: MakeFlown, config: VehicleConfig, straight_mission: Mission
) -> None:
    flights = []
    for seed in (1, 1, 2):
        flown = airborne(make_flown(replace(config, seed=seed)), straight_mission)
        flown.fly(500)
        flights.append(flown.rows())
    assert (flights[0] == flights[1]).all()
    assert not np.allclose(flights[0], flights[2])
