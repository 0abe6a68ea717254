"""Vehicles that give way in the rehearsal: safe, rejoining, and bit for bit as their endpoints do."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario
from sitl.avoidance.intent import PERIOD_TICKS
from sitl.avoidance.yielding import Yielding
from sitl.config import Arm, VehicleConfig
from sitl.events import StatusText
from sitl.formation.channel import Channel
from sitl.formation.failures import FOR_EVER, Failure
from sitl.formation.network import Network
from sitl.modes import Mode
from sitl.rehearsal import Flown, rehearse
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

SAFE_M = 75.0
MEET_S = 90.0
"""When the first vehicle is where the tracks cross."""
Way = tuple[float, float, float]
"""Course, ground speed, and when it is where the tracks cross."""
Crossing = tuple[list[VehicleConfig], dict[int, Mission]]


def crossing(
    vee: Scenario, ways: Sequence[Way], network: Network | None = None, arm: Arm = "full", after_m: float = 2200.0
) -> Crossing:
    """Vehicles on level tracks, straight through one point and on to a circle well apart from each other."""
    sysids = tuple(range(1, len(ways) + 1))
    network = network or Network(sysids, (), Channel(5))
    configs, missions = [], {}
    for config, (course, speed, at_s) in zip(
        vehicle_configs(vee, SwarmOptions(seed=5, delay_s=0.2, arm=arm)), ways, strict=False
    ):

        def item(command: int, s_m: float, course: float = course) -> MissionItem:
            lat_e7, lon_e7 = vee.frame.to_e7(s_m * math.cos(course), s_m * math.sin(course))
            radius_m = 150.0 if command == Command.NAV_LOITER_UNLIM else 0.0
            return MissionItem(command, Frame.GLOBAL, 0, 0, radius_m, 0, lat_e7, lon_e7, 100.0 + vee.frame.alt_m)

        start_m = -speed * at_s
        change = MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 1, speed, -1)
        missions[config.sysid] = Mission(
            (item(Command.NAV_WAYPOINT, start_m), change, item(Command.NAV_LOITER_UNLIM, after_m))
        )
        home_m = (start_m * math.cos(course), start_m * math.sin(course), 100.0)
        configs.append(replace(config, home_m=home_m, network=network, avoid_m=SAFE_M))
    return configs, missions


def without(configs: Sequence[VehicleConfig]) -> list[VehicleConfig]:
    """The same, who do not give way."""
    return [replace(config, avoid_m=None) for config in configs]


def separation_m(flown: Flown) -> float:
    """The least distance of two on their way."""
    ends = [flown.arrived[i] or len(flown.truth[i]) for i in (1, 2)]
    rows = min(ends)
    return float(np.linalg.norm(flown.truth[1][:rows, :3] - flown.truth[2][:rows, :3], axis=1).min())


def fly_together(
    configs: Sequence[VehicleConfig], missions: dict[int, Mission], ticks: int, folder: Path
) -> tuple[dict[int, np.ndarray], dict[int, tuple[Yielding, ...]], list[str]]:
    """The endpoints' own vehicles that hear intents alone, tick by tick; their truth, and what they tell of it."""
    network = configs[0].network
    vehicles, writers = {}, {}
    for config in configs:
        writers[config.sysid] = TruthWriter(folder / f"{config.sysid}.f64")
        vehicle = vehicles[config.sysid] = Vehicle(config, writers[config.sysid])
        vehicle.load(PlanType.MISSION, missions[config.sysid].items)
        assert vehicle.arm() is None
        assert vehicle.set_mode(Mode.AUTO) is None
    for tick in range(ticks):
        there = {i: vehicle for i, vehicle in vehicles.items() if tick < network.deaths.get(i, FOR_EVER)}
        for vehicle in there.values():
            vehicle.observe()
        if tick % PERIOD_TICKS == 0:
            intents = {i: [(vehicle.intent(), 0)] for i, vehicle in there.items()}
            for i, vehicle in there.items():
                vehicle.learn({other: told for other, told in intents.items() if other != i}, set())
        for vehicle in there.values():
            vehicle.advance({})
    for writer in writers.values():
        writer.close()
    texts = [event.text for v in vehicles.values() for event in v.drain_events() if isinstance(event, StatusText)]
    truth = {i: np.fromfile(folder / f"{i}.f64").reshape(-1, 6) for i in vehicles}
    return truth, {i: vehicle.yieldings() for i, vehicle in vehicles.items()}, texts


def assert_same(configs: list[VehicleConfig], missions: dict[int, Mission], folder: Path) -> list[str]:
    rehearsed = rehearse(configs, missions)
    ticks = max(len(rows) for rows in rehearsed.truth.values())
    flown, yieldings, texts = fly_together(configs, missions, ticks, folder)
    for sysid in flown:
        assert rehearsed.truth[sysid].tobytes() == flown[sysid].tobytes(), sysid
    assert rehearsed.yieldings == yieldings
    return texts


@settings(max_examples=20, deadline=None, derandomize=True, phases=(Phase.explicit, Phase.generate))
@given(
    course=st.floats(math.radians(12.0), math.radians(180.0)) | st.floats(-math.radians(180.0), -math.radians(12.0)),
    speeds=st.tuples(st.floats(23.0, 31.0), st.floats(23.0, 31.0)),
    late_s=st.floats(-5.0, 5.0),
    wind=st.sampled_from([(0.0, 0.0), (-2.0, 2.0)]),
)
def test_two_that_meet_stay_apart_and_both_are_back_in_time_and_height(
    vee: Scenario, course: float, speeds: tuple[float, float], late_s: float, wind: tuple[float, float]
) -> None:
    ways = ((0.0, speeds[0], MEET_S), (course, speeds[1], MEET_S + late_s))
    configs, missions = crossing(vee, ways, after_m=4500.0)
    configs = [replace(config, steady_wind_m_s=wind, forecast_wind_m_s=(0.0, 0.0)) for config in configs]
    planned, flown = rehearse(without(configs), missions), rehearse(configs, missions)
    assert separation_m(flown) >= SAFE_M
    assert flown.yieldings[1] == ()
    assert np.array_equal(planned.truth[1][: len(flown.truth[1])], flown.truth[1][: len(planned.truth[1])])
    assert bool(flown.yieldings[2]) == (separation_m(planned) < SAFE_M) or separation_m(planned) < 1.2 * SAFE_M
    end, planned_end = flown.arrived[2], planned.arrived[2]
    assert end is not None
    assert planned_end is not None
    assert abs(end - planned_end) * TICK_S < 2.0
    assert abs(flown.truth[2][end, 2] - planned.truth[2][planned_end, 2]) < 5.0
    assert flown.truth[2][:end, 2].min() > 90.0, "never below the track, but for gusts"


@pytest.mark.parametrize("arm", ["full", "own_schedule", "plain"])
def test_where_nobody_comes_near_they_fly_as_if_they_did_not_give_way_bit_for_bit(vee: Scenario, arm: Arm) -> None:
    configs, missions = crossing(vee, ((0.0, 27.0, MEET_S), (1.0, 27.0, MEET_S + 15.0)), arm=arm)
    flown, planned = rehearse(configs, missions), rehearse(without(configs), missions)
    assert not any(flown.yieldings.values())
    for sysid, truth in planned.truth.items():
        assert flown.truth[sysid].tobytes() == truth.tobytes()


def test_one_that_hangs_is_given_way_to_at_the_pace_of_its_airspeed(vee: Scenario) -> None:
    """The first drifts back in wind that nobody has foreseen, while it tells nothing; planned, they keep apart."""
    network = Network((1, 2), (), Channel(5), failures=(Failure("freeze", frozenset({1}), (), (700, 3000)),))
    configs, missions = crossing(vee, ((0.0, 27.0, MEET_S), (1.5, 27.0, MEET_S + 10.0)), network)
    windy = [replace(config, steady_wind_m_s=(-4.0, 0.0), forecast_wind_m_s=(0.0, 0.0)) for config in configs]
    assert separation_m(rehearse(without(configs), missions)) > SAFE_M
    assert separation_m(rehearse(without(windy), missions)) < SAFE_M
    assert separation_m(rehearse(windy, missions)) >= SAFE_M


SYSIDS = (1, 2, 3)
THREE: tuple[Way, ...] = ((0.0, 27.0, 60.0), (2.0, 26.0, 61.0), (-2.2, 28.0, 60.0))
instants = st.integers(0, 1500)
some = st.frozensets(st.sampled_from(SYSIDS), min_size=1, max_size=2)
intervals = st.builds(lambda start, ticks: (start, start + ticks), instants, st.integers(1, 900))
failures = st.one_of(
    st.builds(lambda who, at: Failure("kill", who, (), (at, FOR_EVER)), some, instants),
    st.builds(lambda who, when: Failure("freeze", who, (), when), some, intervals),
    st.builds(lambda who, when: Failure("silence", who, (), when), st.just(frozenset()) | some, intervals),
    st.builds(lambda who, when: Failure("split", frozenset(), (who,), when), some, intervals),
)
channels = st.builds(
    Channel,
    delay_ticks=st.integers(1, 40),
    jitter_ticks=st.integers(0, 60),
    loss=st.sampled_from([0.0, 0.3]),
    enter=st.sampled_from([0.0, 0.01]),
    leave=st.sampled_from([0.02, 1.0]),
    burst_loss=st.sampled_from([0.5, 1.0]),
)
networks = st.builds(
    lambda channel, links, failed: Network(SYSIDS, (), channel, links, failed),
    channels,
    st.dictionaries(st.sampled_from([(1, 2), (2, 1), (1, 3)]), channels, max_size=2),
    st.lists(failures, max_size=2).map(tuple),
)


@settings(
    max_examples=10,
    deadline=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.generate),
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(network=networks)
def test_whatever_the_network_does_they_give_way_as_their_endpoints_do_bit_for_bit(
    network: Network, vee: Scenario, tmp_path: Path
) -> None:
    assert_same(*crossing(vee, THREE, network, after_m=500.0), tmp_path)


@pytest.mark.parametrize("arm", ["plain", "own_schedule"])
def test_so_they_do_without_neighbours_and_as_plain_autopilots_and_tell_the_stations(
    vee: Scenario, arm: Arm, tmp_path: Path
) -> None:
    network = Network(SYSIDS, (), Channel(5))
    configs, missions = crossing(vee, THREE, network, arm, after_m=500.0)
    still = [replace(config, steady_wind_m_s=(0.0, 0.0), forecast_wind_m_s=(0.0, 0.0)) for config in configs]
    texts = assert_same(still, missions, tmp_path)
    assert any(text.startswith("Yielding to UAV 1: ") for text in texts)
