"""Vehicles as plain autopilots, and the telemetry that they send to a companion."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.frame import LocalFrame
from missions.plan_type import PlanType
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.modes import Mode
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle


def hud_and_position(vehicle: Vehicle, frame: LocalFrame) -> tuple[Any, Any]:
    """VFR_HUD and GLOBAL_POSITION_INT of a vehicle, as it would send them now."""
    now = vehicle.snapshot()
    east, north, up = now.ground_velocity_m_s
    lat_e7, lon_e7 = frame.to_e7(*now.position_m[:2])
    hud = mavlink.MAVLink_vfr_hud_message(now.airspeed_m_s, 0.0, 0, 0, 0.0, 0.0)
    position = mavlink.MAVLink_global_position_int_message(
        round(now.time_s * 1e3),
        lat_e7,
        lon_e7,
        round((now.position_m[2] + frame.alt_m) * 1e3),
        0,
        round(north * 100),
        round(east * 100),
        round(-up * 100),
        0,
    )
    return hud, position


@pytest.fixture(scope="session")
def telemetry() -> Callable[[Vehicle, LocalFrame], tuple[Any, Any]]:
    return hud_and_position


@pytest.fixture
def plain_vehicles(short: Scenario, short_plan: FormationPlan) -> Callable[..., dict[int, Vehicle]]:
    """The short scenario's vehicles, armed and in AUTO, without their own law, in a steady wind."""

    def make(wind_m_s: tuple[float, float]) -> dict[int, Vehicle]:
        vehicles = {}
        for config in vehicle_configs(short, SwarmOptions(1, 0.2, "plain")):
            vehicle = Vehicle(replace(config, steady_wind_m_s=wind_m_s), TruthWriter(None))
            vehicle.load(PlanType.MISSION, short_plan.missions[config.sysid].items)
            assert vehicle.arm() is None
            assert vehicle.set_mode(Mode.AUTO) is None
            vehicles[config.sysid] = vehicle
        return vehicles

    return make
