"""Views of a vehicle in flight."""

import math
from typing import Any

import pytest

from missions.frame import LocalFrame
from sitl.modes import Mode
from sitl.services.stream_messages.view import View


@pytest.fixture
def view(make_vehicle: Any, make_mission: Any, frame: LocalFrame) -> Any:
    """Makes views of a vehicle that flies west and a little north, in a left turn, climbing."""

    def make(plan_ids: tuple[int, int, int] = (77, 0, 0), **changes: Any) -> View:
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
        return View(vehicle.snapshot(), frame, vehicle.home, make_mission(5), plan_ids, epoch_s=1.7e9)

    return make
