"""Vehicles that take others' places: no jump, the mission of the new place, and bit for bit as their endpoints do."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.reassignment import Loss, Move, Reassigned
from missions.reference import Reference, build_reference, spliced
from missions.scenario import Scenario
from sitl.config import VehicleConfig
from sitl.events import ItemReached
from sitl.formation.channel import Channel
from sitl.formation.correction import Correction
from sitl.formation.failures import FOR_EVER, Failure
from sitl.formation.graph import edges
from sitl.formation.network import Network
from sitl.home import home_at
from sitl.modes import Mode
from sitl.rehearsal import rehearse
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

SYSIDS = (1, 2, 3, 4)
KILL_S = 12.0
TAKES_S = 25.0
RADIUS_M = 250.0


def missions(vee: Scenario) -> dict[int, Mission]:
    """Side by side, 200 m apart: a climb, a little more, a loiter; some 100 s."""

    def mission(sysid: int) -> Mission:
        def item(command: int, east: float, z: float, radius_m: float = 0.0) -> MissionItem:
            lat_e7, lon_e7 = vee.frame.to_e7(east, -200.0 * sysid)
            return MissionItem(command, Frame.GLOBAL, 0, 0, radius_m, 0, lat_e7, lon_e7, z + vee.frame.alt_m)

        return Mission(
            (
                item(Command.NAV_WAYPOINT, 0, 0),
                MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 1, 27.0, -1),
                item(Command.NAV_WAYPOINT, 2400, 90),
                item(Command.NAV_LOITER_UNLIM, 2700 + 10 * sysid, 90, 150.0),
            )
        )

    return {sysid: mission(sysid) for sysid in SYSIDS}


class Closing:
    """Those with larger numbers close up, all at once, once a loss is 12 s old."""

    def __init__(self, missions: dict[int, Mission], configs: Sequence[VehicleConfig], vee: Scenario) -> None:
        airframe, self.wind = configs[0].airframe, configs[0].forecast_wind_m_s
        self.missions = missions
        self.planned: dict[int, Reference] = {}
        for config in configs:
            mission = missions[config.sysid].with_home(home_at(config.home_m, vee.frame))
            self.planned[config.sysid] = build_reference(mission, vee.frame, airframe, self.wind)

    def __call__(self, losses: Sequence[Loss]) -> Reassigned:
        left = [sysid for sysid in SYSIDS if not any(sysid in loss.gone for loss in losses)]
        if len(losses) != 1:
            return Reassigned()
        start_s = losses[0].t_s + 22.0
        end_s = start_s + TAKES_S
        moves = []
        for place, sysid in enumerate(left, start=1):
            if place != sysid:
                own, other = self.planned[sysid], self.planned[place]
                joined = spliced(own, other, start_s, end_s, RADIUS_M, self.wind)
                moves.append(Move(sysid, place, start_s - 10.0, start_s, end_s, joined, self.missions[place]))
        return Reassigned(tuple(moves))


def swarm(vee: Scenario, network: Network, **changes: object) -> tuple[list[VehicleConfig], dict[int, Mission]]:
    configs = vehicle_configs(vee, SwarmOptions(seed=5, delay_s=0.2))[: len(SYSIDS)]
    homes = [(0.0, -200.0 * config.sysid, 0.0) for config in configs]
    configs = [replace(one, network=network, home_m=home) for one, home in zip(configs, homes, strict=True)]
    flown = missions(vee)
    closing = Closing(flown, configs, vee)
    return [replace(one, reassign=closing, **changes) for one in configs], flown  # type: ignore[arg-type]


def fly_together(
    configs: Sequence[VehicleConfig], flown: dict[int, Mission], ticks: int, folder: Path
) -> tuple[dict[int, np.ndarray], dict[int, Vehicle], dict[int, list[object]]]:
    """The endpoints' own vehicles, tick by tick; their truth, they themselves, and what they have told."""
    network = configs[0].network
    vehicles, writers, told = {}, {}, {}
    for config in configs:
        writers[config.sysid] = TruthWriter(folder / f"{config.sysid}.f64")
        vehicle = vehicles[config.sysid] = Vehicle(config, writers[config.sysid])
        vehicle.load(PlanType.MISSION, flown[config.sysid].items)
        assert vehicle.arm() is None
        assert vehicle.set_mode(Mode.AUTO) is None
        told[config.sysid] = list[object]()
    said: list[dict[int, Correction]] = []
    for tick in range(ticks):
        there = {i: vehicle for i, vehicle in vehicles.items() if tick < network.deaths.get(i, FOR_EVER)}
        said.append({sysid: vehicle.observe() for sysid, vehicle in there.items()})
        for sysid, vehicle in there.items():
            delays = {other: network.channel_of(other, sysid).delay_ticks for other in network.neighbours(sysid)}
            heard = {other: said[tick - k].get(other) for other, k in delays.items() if k <= tick}
            vehicle.advance({other: sample for other, sample in heard.items() if sample is not None})
            told[sysid] += vehicle.drain_events()
    for writer in writers.values():
        writer.close()
    truth = {i: np.fromfile(folder / f"{i}.f64").reshape(-1, 6) for i in vehicles}
    return truth, vehicles, told


def killing(sysid: int, tick: int, *others: Failure) -> Network:
    kill = Failure("kill", frozenset({sysid}), (), (tick, FOR_EVER))
    return Network(SYSIDS, edges("ring", SYSIDS), Channel(5), failures=(kill, *others))


intervals = st.builds(lambda start, ticks: (start, start + ticks), st.integers(0, 1500), st.integers(1, 400))
others = st.one_of(
    st.builds(lambda who, when: Failure("freeze", frozenset({who}), (), when), st.sampled_from(SYSIDS), intervals),
    st.builds(lambda when: Failure("silence", frozenset(), (), when), intervals),
)
networks = st.builds(
    lambda sysid, tick, failures: killing(sysid, tick, *failures),
    st.sampled_from(SYSIDS[:-1]),
    st.integers(60, 500),
    st.lists(others, max_size=2),
)


@settings(
    max_examples=5,
    deadline=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.generate),
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(network=networks)
def test_whenever_one_is_killed_the_rehearsal_flies_as_the_vehicles_do(
    network: Network, vee: Scenario, tmp_path: Path
) -> None:
    configs, flown = swarm(vee, network)
    rehearsed = rehearse(configs, flown)
    ticks = max(len(rows) for rows in rehearsed.truth.values())
    truth, _, told = fly_together(configs, flown, ticks, tmp_path)
    for sysid in SYSIDS:
        assert rehearsed.truth[sysid].tobytes() == truth[sysid].tobytes(), sysid
    assert any("Takes the place" in str(event) for events in told.values() for event in events)


def test_a_vehicle_that_moves_goes_smoothly_to_its_new_place_and_has_the_mission_of_that(
    vee: Scenario, tmp_path: Path
) -> None:
    configs, flown = swarm(vee, killing(1, round(KILL_S / TICK_S)))
    closing = configs[0].reassign
    assert isinstance(closing, Closing)
    truth, vehicles, told = fly_together(configs, flown, round(110.0 / TICK_S), tmp_path)
    known_s = configs[0].network.epochs[1][0] * TICK_S
    for sysid in (2, 3, 4):
        (move,) = closing([Loss(known_s, frozenset({1}))]).of(sysid)
        t_s = np.arange(truth[sysid].shape[0]) * TICK_S
        flying = t_s < move.reference.duration_s
        away = np.linalg.norm(truth[sysid][:, :3] - move.reference.positions(t_s), axis=1)[flying]
        assert away.max() < 12.0, "it never leaves what it is to fly"
        settled = (t_s > move.end_s + 10.0) & (t_s < closing.planned[sysid - 1].duration_s)
        place = closing.planned[sysid - 1].positions(t_s[settled])
        assert np.linalg.norm(truth[sysid][settled, :3] - place, axis=1).max() < 8.0
        assert vehicles[sysid].mission.items[1:] == flown[sysid - 1].items[1:]
        assert [event.seq for event in told[sysid] if isinstance(event, ItemReached)] == [2, 3]
        assert vehicles[sysid].snapshot().mission_complete


def test_who_has_left_its_mission_stays_out_and_says_so(vee: Scenario, tmp_path: Path) -> None:
    configs, flown = swarm(vee, killing(1, round(KILL_S / TICK_S)))
    vehicle = Vehicle(configs[1], TruthWriter(None))
    vehicle.load(PlanType.MISSION, flown[2].items)
    assert vehicle.arm() is None
    assert vehicle.set_mode(Mode.AUTO) is None
    for _ in range(round(60.0 / TICK_S)):
        vehicle.observe()
        vehicle.advance({})
        if vehicle.tick == 400:
            assert vehicle.set_mode(Mode.LOITER) is None
    texts = [str(event) for event in vehicle.drain_events()]
    assert any("does not take the place of UAV 1" in text for text in texts)
    assert vehicle.mission.items[1:] == flown[2].items[1:]


def test_without_corrections_nobody_knows_who_is_gone(vee: Scenario) -> None:
    configs = vehicle_configs(vee, SwarmOptions(1, 0.2, "plain", reassign=lambda losses: Reassigned()))
    assert [config.reassign for config in configs] == [None] * 9
