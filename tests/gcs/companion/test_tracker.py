"""What telemetry says of a vehicle beside its plan is what its own law knows."""

from collections.abc import Callable
from typing import Any

import pytest

from gcs.companion.tracker import Tracker
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.ticks import TICK_S

EVERY_TICKS = 5


def test_five_messages_a_second_tell_place_deviation_and_wind(
    short: Scenario, short_plan: FormationPlan, plain_vehicles: Callable[..., Any], telemetry: Callable[..., Any]
) -> None:
    vehicle = plain_vehicles((-4.0, 0.0))[1]
    tracker = Tracker(short_plan.references(short)[1], short.frame)
    hud, position = telemetry(vehicle, short.frame)
    assert tracker.fix(position, hud.airspeed) is None  # on the ground
    winds = []
    for tick in range(round(80.0 / TICK_S)):
        vehicle.observe()
        lost = 500 < tick < 900  # 16 s of silence
        if tick % EVERY_TICKS == 0 and not lost:
            hud, position = telemetry(vehicle, short.frame)
            fix = tracker.fix(position, hud.airspeed)
            assert fix is not None
            own = vehicle._pilot.errors
            assert fix.time_s == pytest.approx(tick * TICK_S, abs=0.02)
            assert fix.along_m == pytest.approx(own.along, abs=0.5)
            assert fix.along_rate_m_s == pytest.approx(own.along_rate, abs=0.1)
            winds.append(fix.tailwind_m_s)
        vehicle.advance({})
    assert tracker.began_at_s_m == pytest.approx(0.0, abs=2.0)
    straight = winds[25:150]  # on the leg that leads east, gusts and all
    assert sum(straight) / len(straight) == pytest.approx(-4.0, abs=1.5)


def test_who_is_first_heard_of_in_flight_is_on_schedule_there(
    short: Scenario, short_plan: FormationPlan, plain_vehicles: Callable[..., Any], telemetry: Callable[..., Any]
) -> None:
    vehicle = plain_vehicles((0.0, 0.0))[2]
    for _ in range(round(30.0 / TICK_S)):
        vehicle.observe()
        vehicle.advance({})
    tracker = Tracker(short_plan.references(short)[2], short.frame)
    hud, position = telemetry(vehicle, short.frame)
    fix = tracker.fix(position, hud.airspeed)
    assert fix is not None
    assert tracker.began_at_s_m is not None
    assert tracker.began_at_s_m > 500.0
    assert fix.along_m == pytest.approx(0.0, abs=0.1)
    late = telemetry(vehicle, short.frame)[1]
    late.time_boot_ms -= 1000
    assert tracker.fix(late, hud.airspeed) is None
