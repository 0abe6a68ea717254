"""Endpoints' faces on real sockets, for the station to talk to; plans and truth made by hand, to be measured."""

import contextlib
import math
import re
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from gcs.flight_record import Event, FlightRecord, Timing
from missions.commands import Command, Frame
from missions.environment import ground_height_m
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from missions.reference import Reference
from missions.scenario import Scenario, VehicleModel, load_scenario, read_scenario_text
from planner.formation_plan import FitnessTerms, FormationPlan, UavPlan
from planner.plan import plan
from sitl.services.face import MavlinkFace
from sitl.services.links import StationLinks
from sitl.services.signing import Signing
from sitl.serving import TURN_S
from sitl.ticks import TICK_S

Serve = Callable[..., StationLinks]
FloatArray = npt.NDArray[np.float64]
STRAIGHT_S = 1243.0
"""Planned arrival of all vehicles on straight lines in `radars`."""


@pytest.fixture
def serve(frame: LocalFrame) -> Iterator[Serve]:
    """Serves a fake vehicle's face in a thread of its own, to stations over UDP and whoever comes over TCP."""
    with contextlib.ExitStack() as stack:

        def start(vehicle: Any, *stations: tuple[str, int], signing: Signing | None = None) -> StationLinks:
            links = stack.enter_context(contextlib.closing(StationLinks(0, stations)))
            face = MavlinkFace(vehicle, frame, links.send, time.monotonic, signing)
            links.attach(face)
            stopped = threading.Event()

            def run() -> None:
                while not stopped.is_set():
                    links.poll(TURN_S)
                    face.on_tick()

            thread = threading.Thread(target=run)

            def stop() -> None:
                stopped.set()
                links.stop_waiting()
                thread.join()

            thread.start()
            stack.callback(stop)
            face.on_simulated_tick(vehicle.snapshot())
            return links

        yield start


@pytest.fixture(scope="session")
def short_scenario(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three aircraft of the shipped V on two legs of 1.2 km with a turn of 30 degrees: some 86 s of flight."""
    text, _ = read_scenario_text("vee")
    head, *vehicles = re.split(r"(?=\[\[vehicles\]\])", text)
    last, rest = vehicles[-1].split("# Aerosonde", 1)
    del last
    head = re.sub(
        r"points = \[.*?\n\]",
        "points = [[0.0, 0.0, 0.0], [1200.0, 0.0, 80.0], [2239.0, 600.0, 80.0]]",
        head,
        flags=re.S,
    )
    head = head.replace('name = "vee"', 'name = "short"')
    file = tmp_path_factory.mktemp("scenario") / "short.toml"
    file.write_text(head + "".join(vehicles[:3]) + "# Aerosonde" + rest)
    return file


@pytest.fixture(scope="session")
def short(short_scenario: Path) -> Scenario:
    return load_scenario(str(short_scenario))


@pytest.fixture(scope="session")
def short_plan(short: Scenario) -> FormationPlan:
    return plan(short)


@pytest.fixture(scope="session")
def radars() -> Scenario:
    return load_scenario("radars")


@pytest.fixture(scope="session")
def few() -> Callable[[Scenario, int], Scenario]:
    """The same scenario with its first vehicles only."""
    return lambda scenario, count: scenario.model_copy(update={"vehicles": scenario.vehicles[:count]})


@pytest.fixture(scope="session")
def straight_plan() -> Callable[[Scenario], FormationPlan]:
    """Plans from origins straight to targets, all arriving together."""

    def make(scenario: Scenario) -> FormationPlan:
        uavs = tuple(_straight_uav(scenario, vehicle) for vehicle in scenario.vehicles)
        return FormationPlan(scenario.name, 7, "by hand", uavs, compile_s=0.1, plan_s=0.2)

    return make


@pytest.fixture(scope="session")
def amsl_m() -> Callable[[MissionItem, MissionItem, Scenario], float]:
    """What an autopilot takes an altitude for, in metres above the sea: given item, home, and whose ground it knows."""

    def amsl(item: MissionItem, home: MissionItem, scenario: Scenario) -> float:
        if item.frame == Frame.GLOBAL_RELATIVE_ALT:
            return home.alt_m + item.alt_m
        if item.frame == Frame.GLOBAL_TERRAIN_ALT:
            x, y = scenario.frame.from_e7(item.lat_e7, item.lon_e7)
            return item.alt_m + ground_height_m(x, y, scenario.environment.terrain) + scenario.origin.alt_m
        assert item.frame == Frame.GLOBAL
        return item.alt_m

    return amsl


def _straight_uav(scenario: Scenario, vehicle: VehicleModel) -> UavPlan:
    ends = np.array([scenario.origin_m(vehicle), scenario.target_m(vehicle)])
    length_m = math.dist(*ends)

    def at(command: int, point: FloatArray) -> MissionItem:
        lat_e7, lon_e7 = scenario.frame.to_e7(point[0], point[1])
        alt_m = float(point[2]) + scenario.origin.alt_m
        return MissionItem(command, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m)

    ground_speed = MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 1.0, math.dist(*ends[:, :2]) / STRAIGHT_S, -1.0)
    items = (at(Command.NAV_WAYPOINT, ends[0]), ground_speed, at(Command.NAV_LOITER_UNLIM, ends[1]))
    terms = FitnessTerms(length_m / 1000.0, 0.7, 0.0, 0.0, 0.9)
    history = ((150, None), (300, 1.2 * terms.fitness), (450, terms.fitness))
    return UavPlan(vehicle.sysid, vehicle.name, ends, terms, length_m, length_m, 450, history, Mission(items))


@pytest.fixture(scope="session")
def fly_exactly() -> Callable[[dict[int, Reference]], dict[int, FloatArray]]:
    """Truth of vehicles that are where their plan wants them at every tick, and fly on for ten seconds."""

    def fly(references: dict[int, Reference]) -> dict[int, FloatArray]:
        longest_s = max(reference.duration_s for reference in references.values())
        t_s = np.arange(math.ceil((longest_s + 10.0) / TICK_S)) * TICK_S
        return {sysid: with_velocity(references[sysid].positions(t_s)) for sysid in sorted(references)}

    return fly


def with_velocity(positions_m: FloatArray) -> FloatArray:
    """Rows of truth in still air from positions, (n_tick, 3)."""
    velocity = np.gradient(positions_m, TICK_S, axis=0)
    speed = np.linalg.norm(velocity, axis=1)
    angles = np.column_stack([np.arcsin(velocity[:, 2] / speed), np.arctan2(velocity[:, 1], velocity[:, 0])])
    return np.column_stack([positions_m, speed, angles])


@pytest.fixture(scope="session")
def make_record() -> Callable[..., FlightRecord]:
    """Records of flights in which all items were uploaded and verified."""

    def make(plan: FormationPlan, **changes: Any) -> FlightRecord:
        items = {uav.sysid: len(uav.mission) for uav in plan.uavs}
        values: dict[str, Any] = {
            "seed": plan.seed,
            "delay_s": 0.2,
            "arm": "full",
            "items_uploaded": items,
            "items_verified": items,
            "timing": Timing(plan.compile_s, plan.plan_s, 0.5, 0.2, 20.0, 1300.0, 65.0),
            "events": (Event(1243.1, 1, "arrived"),),
            "lost": {},
            "delay_margin_s": 0.65,
        }
        return FlightRecord(**(values | changes))

    return make
