"""Whatever a vehicle is told, in any order: no exception, never below the ground, within its limits, and no NaN."""

import contextlib
import math
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.environment.terrain import ground_height_m
from missions.errors import InputError
from missions.mission import MissionItem
from missions.plan_type import PlanType
from missions.scenario import load_scenario
from sitl.modes import Mode
from sitl.pilot import Phase
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

CONFIGS = [vehicle_configs(load_scenario(name), SwarmOptions(seed=1, delay_s=0.2))[0] for name in ("vee", "mountains")]
STALLED_SHARE, TOO_FAST_M_S = 0.7, 5.0
"""What gusts may take from the least airspeed, or add to the greatest."""

metres = st.floats(-3000, 3000) | st.sampled_from([0.0, 1.0, 30.0, 1000.0])
height = st.sampled_from([0.0, 30.0, 100.0, 300.0]) | st.floats(-50, 500)
radius = st.sampled_from([0.0, -200.0, 50.0, 400.0])
PLACES = [Command.NAV_WAYPOINT] * 4 + [
    Command.NAV_LOITER_UNLIM,
    Command.NAV_LOITER_TIME,
    Command.NAV_LOITER_TURNS,
    Command.NAV_LOITER_TO_ALT,
    Command.NAV_LAND,
]
Item = tuple[int, float, float, float, float, float, float]
items = st.lists(
    st.tuples(st.sampled_from(PLACES), metres, metres, height, st.sampled_from([0.0, 1.0, 20.0]), radius, radius)
    | st.tuples(st.just(Command.DO_JUMP), *[st.just(0.0)] * 3, st.integers(1, 6), st.integers(-1, 3), st.just(0.0))
    | st.tuples(
        st.just(Command.DO_CHANGE_SPEED),
        *[st.just(0.0)] * 3,
        st.integers(0, 1),
        st.sampled_from([-2, 10, 22, 30, 50]),
        st.just(0.0),
    )
    | st.sampled_from([Command.NAV_TAKEOFF, Command.NAV_RETURN_TO_LAUNCH, Command.DO_LAND_START]).map(
        lambda command: (command, 0.0, 0.0, 50.0, 0.0, 0.0, 0.0)
    ),
    min_size=1,
    max_size=7,
)
NAMES = ["RTL_AUTOLAND", "RTL_ALTITUDE", "FENCE_TYPE", "FENCE_ACTION", "FENCE_RADIUS", "MIS_RESTART", "WP_LOITER_RAD"]
NAMES += ["AIRSPEED_CRUISE", "AIRSPEED_MIN", "AIRSPEED_MAX", "FENCE_ALT_MIN", "FENCE_ALT_MAX", "RTL_RADIUS"]


def item(vehicle: Vehicle, wanted: Item) -> MissionItem:
    command, east, north, z, p1, p2, p3 = wanted
    x, y, _ = vehicle.snapshot().home_m
    lat_e7, lon_e7 = vehicle._config.frame.to_e7(x + east, y + north) if command in PLACES else (0, 0)
    return MissionItem(command, Frame.GLOBAL_RELATIVE_ALT, p1, p2, p3, 0.0, lat_e7, lon_e7, z)


def load(wanted: list[Item]) -> Callable[[Vehicle], object]:
    def ask(vehicle: Vehicle) -> None:
        with contextlib.suppress(InputError):
            vehicle.load(PlanType.MISSION, (vehicle.home, *(item(vehicle, one) for one in wanted)))
        vehicle.arm(force=True)
        vehicle.set_mode(Mode.AUTO)

    return ask


def home_at(east: float, north: float) -> Callable[[Vehicle], object]:
    def ask(vehicle: Vehicle) -> str | None:
        lat_e7, lon_e7 = vehicle._config.frame.to_e7(east, north)
        alt_m = vehicle.home.alt_m
        return vehicle.set_home(
            MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)
        )

    return ask


def set_to(name: str, share: float) -> Callable[[Vehicle], object]:
    def ask(vehicle: Vehicle) -> None:
        one = vehicle.parameters._definitions[name]
        with contextlib.suppress(InputError):
            vehicle.parameters.set(name, one.low + share * (min(one.high, 2000.0) - one.low))

    return ask


asked = st.one_of(
    items.map(load),
    items.map(load),
    st.sampled_from(list(Mode)).map(lambda mode: lambda vehicle: vehicle.set_mode(mode)),
    st.integers(0, 8).map(lambda seq: lambda vehicle: vehicle.set_current(seq)),
    st.tuples(st.sampled_from([-2.0, 5.0, 20.0, 30.0, 60.0]), st.booleans()).map(
        lambda s: lambda vehicle: vehicle.change_speed(s[0], over_ground=s[1])
    ),
    st.floats(1, 400).map(lambda z: lambda vehicle: vehicle.take_off(z)),
    st.tuples(st.just(Command.NAV_LOITER_UNLIM), metres, metres, height, radius, radius, radius).map(
        lambda at: lambda vehicle: vehicle.reposition(item(vehicle, at))
    ),
    st.just(lambda vehicle: vehicle.set_home(None)),
    st.builds(home_at, metres, metres),
    st.booleans().map(lambda force: lambda vehicle: vehicle.arm(force=force)),
    st.sampled_from([False, False, True]).map(lambda force: lambda vehicle: vehicle.disarm(force=force)),
    st.just(lambda vehicle: vehicle.start_mission()),
    st.booleans().map(lambda on: lambda vehicle: vehicle.enable_fence(on)),
    st.builds(set_to, st.sampled_from(NAMES), st.floats(0, 1)),
)


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.sampled_from(CONFIGS), st.lists(st.tuples(asked, st.sampled_from([1, 50, 400, 1200])), min_size=2, max_size=12)
)
def test_nothing_breaks_it(config: Any, flight: list[tuple[Callable[[Vehicle], object], int]]) -> None:
    vehicle, airframe = Vehicle(config, TruthWriter(None)), config.airframe
    for ask, ticks in flight:
        ask(vehicle)
        for _ in range(ticks):
            vehicle.observe()
            vehicle.advance({})
            air = vehicle._pilot.flight.air
            assert all(map(math.isfinite, air))
            assert air.h >= ground_height_m(air.x, air.y, config.terrain) - 1e-9
            assert airframe.airspeed_max_m_s + TOO_FAST_M_S > air.V
            assert abs(vehicle._pilot.flight.controls.bank) <= airframe.bank_max
            if vehicle._pilot.phase == Phase.FLYING:
                assert STALLED_SHARE * airframe.airspeed_min_m_s < air.V
        assert vehicle.snapshot().breach_count >= 0
        assert len(vehicle.drain_events()) < 300
