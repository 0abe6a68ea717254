"""The rehearsal flies what endpoints fly, bit for bit."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario
from sitl.config import Arm, VehicleConfig
from sitl.formation.channel import Channel
from sitl.formation.correction import Correction
from sitl.formation.failures import FOR_EVER, Failure
from sitl.formation.graph import edges
from sitl.formation.network import Network
from sitl.modes import Mode
from sitl.rehearsal import rehearse
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter, shifts_file
from sitl.vehicle import Vehicle

COUNT = 4
SYSIDS = tuple(range(1, COUNT + 1))


@pytest.fixture(scope="module")
def missions(vee: Scenario) -> dict[int, Mission]:
    """Side by side: a climb, a turn, a loiter; some 40 s."""

    def mission(sysid: int) -> Mission:
        def item(command: int, east: float, north: float, z: float, radius_m: float = 0.0) -> MissionItem:
            lat_e7, lon_e7 = vee.frame.to_e7(east, north - 200.0 * sysid)
            return MissionItem(command, Frame.GLOBAL, 0, 0, radius_m, 0, lat_e7, lon_e7, z + vee.frame.alt_m)

        return Mission(
            (
                item(Command.NAV_WAYPOINT, 0, 0, 0),
                MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 0, 27 + 0.3 * sysid, -1),
                item(Command.NAV_WAYPOINT, 600, 0, 50),
                item(Command.NAV_LOITER_UNLIM, 1000, 250, 60, 150.0),
            )
        )

    return {sysid: mission(sysid) for sysid in SYSIDS}


def swarm(vee: Scenario, network: Network, arm: Arm = "full") -> list[VehicleConfig]:
    configs = vehicle_configs(vee, SwarmOptions(seed=5, delay_s=0.2, arm=arm))[:COUNT]
    return [replace(config, network=network) for config in configs]


def fly_together(
    configs: Sequence[VehicleConfig], missions: dict[int, Mission], ticks: int, folder: Path
) -> tuple[dict[int, np.ndarray], list[tuple[int, int, int, bool]]]:
    """The endpoints' own vehicles, tick by tick; their truth, and the changes of edges by (tick, from, to)."""
    network = configs[0].network
    vehicles, writers = {}, {}
    for config in configs:
        file = folder / f"{config.sysid}.f64"
        writers[config.sysid] = TruthWriter(file, shifts=config.swarm_clock)
        vehicle = vehicles[config.sysid] = Vehicle(config, writers[config.sysid])
        vehicle.load(PlanType.MISSION, missions[config.sysid].items)
        assert vehicle.arm() is None
        assert vehicle.set_mode(Mode.AUTO) is None
    said: list[dict[int, Correction]] = []
    for tick in range(ticks):
        there = {i: vehicle for i, vehicle in vehicles.items() if tick < network.deaths.get(i, FOR_EVER)}
        said.append({sysid: vehicle.observe() for sysid, vehicle in there.items()})
        for sysid, vehicle in there.items():
            delays = {other: network.channel_of(other, sysid).delay_ticks for other in network.neighbours(sysid)}
            heard = {other: said[tick - k].get(other) for other, k in delays.items() if k <= tick}
            vehicle.advance({other: sample for other, sample in heard.items() if sample is not None})
    for writer in writers.values():
        writer.close()
    truth = {i: np.fromfile(folder / f"{i}.f64").reshape(-1, 6) for i in vehicles}
    changes = [(tick, other, i, used) for i, v in vehicles.items() for tick, other, used in v._pilot.formation.edges]
    return truth, sorted(changes)


def assert_same(configs: list[VehicleConfig], missions: dict[int, Mission], folder: Path) -> None:
    rehearsed = rehearse(configs, missions)
    ticks = max(len(rows) for rows in rehearsed.truth.values())
    flown, changes = fly_together(configs, missions, ticks, folder)
    for sysid in flown:
        assert rehearsed.truth[sysid].tobytes() == flown[sysid].tobytes(), sysid
    for sysid, rows in rehearsed.shifts.items():
        on_path = slice((rehearsed.arrived[sysid] or 0) + 1)
        shifts = np.fromfile(shifts_file(folder / f"{sysid}.f64")).reshape(-1, 2)
        assert rows[on_path].tobytes() == shifts[on_path].tobytes(), sysid
    assert rehearsed.edges == changes


channels = st.builds(
    Channel,
    delay_ticks=st.integers(1, 12),
    jitter_ticks=st.integers(0, 8),
    loss=st.sampled_from([0.0, 0.1, 0.9]),
    enter=st.sampled_from([0.0, 0.05]),
    leave=st.sampled_from([0.02, 1.0]),
    burst_loss=st.sampled_from([0.5, 1.0]),
)
instants = st.integers(0, 900)
vehicles_of = st.frozensets(st.sampled_from(SYSIDS), min_size=1, max_size=2)
intervals = st.builds(lambda start, ticks: (start, start + ticks), instants, st.integers(1, 600))
failures = st.one_of(
    st.builds(lambda who, at: Failure("kill", who, (), (at, FOR_EVER)), vehicles_of, instants),
    st.builds(lambda who, when: Failure("freeze", who, (), when), vehicles_of, intervals),
    st.builds(lambda who, when: Failure("silence", who, (), when), st.just(frozenset()) | vehicles_of, intervals),
    st.builds(lambda who, when: Failure("split", frozenset(), (who,), when), vehicles_of, intervals),
)
networks = st.builds(
    lambda kind, channel, links, failed, stale: Network(SYSIDS, edges(kind, SYSIDS), channel, links, failed, stale),
    st.sampled_from(["ring", "line", "star", "complete"]),
    channels,
    st.dictionaries(st.sampled_from([(1, 2), (2, 1), (4, 3)]), channels, max_size=2),
    st.lists(failures, max_size=3).map(tuple),
    st.integers(1, 60),
)


@settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.generate),
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(network=networks)
def test_whatever_the_network_does_and_whoever_fails_it_is_the_endpoints_flight_bit_for_bit(
    network: Network, vee: Scenario, missions: dict[int, Mission], tmp_path: Path
) -> None:
    assert_same(swarm(vee, network), missions, tmp_path)


@settings(
    max_examples=6,
    deadline=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.generate),
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(network=networks, wind_m_s=st.sampled_from([-8.0, -4.0, 6.0, 9.0]))
def test_so_it_is_by_the_swarms_clock_in_wind_that_nobody_can_hold_out_against(
    network: Network, wind_m_s: float, vee: Scenario, missions: dict[int, Mission], tmp_path: Path
) -> None:
    windy = [replace(config, swarm_clock=True, steady_wind_m_s=(wind_m_s, 0.0)) for config in swarm(vee, network)]
    assert_same(windy, missions, tmp_path)


@pytest.mark.parametrize("arm", ["plain", "own_schedule"])
def test_so_it_is_without_neighbours_and_as_plain_autopilots(
    arm: Arm, vee: Scenario, missions: dict[int, Mission], tmp_path: Path
) -> None:
    network = Network(SYSIDS, edges("ring", SYSIDS), Channel(5))
    assert_same(swarm(vee, network, arm), missions, tmp_path)


def test_vehicles_with_gains_of_their_own_fly_as_their_endpoints_do(
    vee: Scenario, missions: dict[int, Mission], tmp_path: Path
) -> None:
    configs = swarm(vee, Network(SYSIDS, edges("ring", SYSIDS), Channel(5)))
    unlike = [replace(config, gains=config.gains._replace(k0=0.01 * (config.sysid == 2))) for config in configs]
    assert_same(unlike, missions, tmp_path)
    assert rehearse(unlike, missions).truth[1].tobytes() != rehearse(configs, missions).truth[1].tobytes()


def test_thrust_and_speed_against_the_schedule_are_told_of_every_tick(
    vee: Scenario, missions: dict[int, Mission]
) -> None:
    flown = rehearse(swarm(vee, Network(SYSIDS, edges("ring", SYSIDS), Channel(5))), missions)
    for sysid in SYSIDS:
        truth, thrust, rate = flown.truth[sysid], flown.thrust_n[sysid], flown.along_rate_m_s[sysid]
        assert len(thrust) == len(rate) == len(truth)
        assert np.all((thrust >= 0.0) & (thrust <= vee.airframe.static_thrust_n))
        end = flown.arrived[sysid]
        assert end is not None
        assert np.all(np.isfinite(rate[: end + 1]))
        assert np.all(np.isnan(rate[end + 1 :]))


def test_what_it_cannot_fly_it_refuses_by_the_vehicles_name(vee: Scenario, missions: dict[int, Mission]) -> None:
    network = Network(SYSIDS, edges("ring", SYSIDS), Channel(5))
    landing = Mission((*missions[2].items[:-1], replace(missions[2].items[-1], command=Command.NAV_LOITER_TURNS)))
    with pytest.raises(InputError, match=r"vehicle 2: .*loiter at the end"):
        rehearse(swarm(vee, network), {**missions, 2: landing})
