"""How far a place is moved on its way from the plan to a mission, through files, to a vehicle, and back in telemetry.

Each stage is compared with the one before it, in metres of the local frame: the waypoints of a plan, and every position
that a vehicle tells with its truth of the same tick. How well an aircraft follows its path is another matter, and not
in it.
"""

import asyncio
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from gcs.export import ExportOptions, export, ground_amsl_m
from gcs.flight import FlightOptions, fly
from gcs.run_folder import make_run_folder
from gcs.tlog_reader import read_tlog
from gcs.truth import H, X, read_truth
from gcs.watch import VehicleStatus
from missions.altitude_frame import AltitudeFrame, GroundAmsl, altitudes_amsl_m
from missions.commands import Command
from missions.formats.mission_file import read_mission_file
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.services.mission_items import decode_item
from sitl.services.peer import Message
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]
LIMIT_M = 0.02
"""What the whole chain may be off."""
FORMATS = ("plan", "waypoints")


@dataclass(frozen=True)
class Stage:
    """What a stage does to places.

    Attributes:
        name: from where to where.
        compared: how many places.
        horizontal_m, vertical_m, distance_m: the largest errors; the last in space.
    """

    name: str
    compared: int
    horizontal_m: float
    vertical_m: float
    distance_m: float


@dataclass(frozen=True)
class PositionChain:
    """One scenario's.

    Attributes:
        stages: each against the one before.
        whole: a vehicle's offset from a waypoint, as file and telemetry have it, against the one from the planned
            waypoint to the true position; for every waypoint with every position.
    """

    scenario: str
    stages: tuple[Stage, ...]
    whole: Stage

    @property
    def holds(self) -> bool:
        """Whether the whole keeps within `LIMIT_M`."""
        return self.whole.distance_m < LIMIT_M

    def as_json(self) -> dict[str, Any]:
        """As JSON values."""
        return {**asdict(self), "limit_m": LIMIT_M, "holds": self.holds}


def stage(name: str, errors_m: Sequence[FloatArray]) -> Stage:
    """The largest of some errors, arrays of (n, 3) in metres: east, north, up."""
    errors = np.concatenate(errors_m)
    flat = np.hypot(errors[:, 0], errors[:, 1])
    largest = (flat, np.abs(errors[:, 2]), np.linalg.norm(errors, axis=1))
    return Stage(name, len(errors), *(float(values.max()) for values in largest))


def waypoints_m(mission: Mission, frame: LocalFrame, ground: GroundAmsl) -> FloatArray:
    """Home and all waypoints of a mission, (n, 3) in the local frame."""
    altitudes_m = altitudes_amsl_m(mission, ground)
    return np.array(
        [
            (*frame.from_e7(item.lat_e7, item.lon_e7), altitude_m - frame.alt_m)
            for item, altitude_m in zip(mission, altitudes_m, strict=True)
            if item.command == Command.NAV_WAYPOINT
        ]
    )


def measure_chain(scenario: Scenario, formation: FormationPlan) -> PositionChain:
    """Write a plan's files, read them, fly what the `.plan` files hold on endpoints, and compare what is told.

    Raises:
        InputError, TransferError: as of `gcs.flight.fly`.
    """
    frame, ground = scenario.frame, ground_amsl_m(scenario)

    def places(missions: dict[int, Mission]) -> list[FloatArray]:
        return [waypoints_m(missions[uav.sysid], frame, ground) for uav in formation.uavs]

    with tempfile.TemporaryDirectory() as name:
        read = {altitude: dict(_read_back(scenario, formation, altitude, Path(name))) for altitude in AltitudeFrame}
        imported = {sysid: missions["plan"] for sysid, missions in read[AltitudeFrame.amsl].items()}
        run = make_run_folder(Path(name) / "run", scenario.name)
        uavs = tuple(replace(uav, mission=imported[uav.sysid]) for uav in formation.uavs)
        options = FlightOptions(delay_s=scenario.formation.delay_s)
        asyncio.run(fly(scenario, replace(formation, uavs=uavs), run, options, _ignore, _show_nothing))
        held, telemetry = {}, []
        for uav in formation.uavs:
            said = _said(run.logs / f"{uav.sysid}.tlog", uav.sysid)
            held[uav.sysid] = held_mission(said)
            telemetry.append(telemetry_errors_m(said, read_truth(run.truth / f"{uav.sysid}.f64"), frame))

    planned, written = [uav.waypoints_m for uav in formation.uavs], places(formation.missions)
    stages = [stage("plan to mission", _each_less(written, planned))]
    for altitude, missions in read.items():
        errors = []
        for file_format in FORMATS:
            errors += _each_less(places({sysid: both[file_format] for sysid, both in missions.items()}), written)
        stages.append(stage(f"mission to files and back, {altitude}", errors))
    kept = places(held)
    stages.append(stage("file to vehicle and back", _each_less(kept, places(imported))))
    stages.append(stage("vehicle to telemetry", telemetry))
    offsets = [
        (told[:, None] - waypoint[None]).reshape(-1, 3)
        for told, waypoint in zip(telemetry, _each_less(kept, planned), strict=True)
    ]
    return PositionChain(scenario.name, tuple(stages), stage("the whole", offsets))


def held_mission(said: Sequence[Message]) -> Mission:
    """The mission that a vehicle gave back, from what it said."""
    items = {message.seq: decode_item(message) for message in said if message.get_type() == "MISSION_ITEM_INT"}
    return Mission(tuple(items[seq] for seq in range(len(items))))


def telemetry_errors_m(said: Sequence[Message], truth: FloatArray, frame: LocalFrame) -> FloatArray:
    """GLOBAL_POSITION_INT less the truth of its tick, (n, 3) in metres.

    Args:
        said: by the vehicle.
        truth: its rows, as of `gcs.truth.read_truth`.
        frame: that they are in.
    """
    errors = []
    for message in said:
        if message.get_type() == "GLOBAL_POSITION_INT":
            told = (*frame.from_e7(message.lat, message.lon), message.alt / 1e3 - frame.alt_m)
            true = truth[round(message.time_boot_ms / 1e3 / TICK_S) :, X : H + 1][:1]
            errors.append(told - true)  # nothing, of what was told after the last row
    return np.concatenate(errors)


def _read_back(
    scenario: Scenario, formation: FormationPlan, altitude: AltitudeFrame, folder: Path
) -> Iterator[tuple[int, dict[str, Mission]]]:
    """Each vehicle's missions by file format, written and read."""
    files = [
        export(scenario, formation, ExportOptions(file_format, altitude=altitude), folder).files
        for file_format in FORMATS
    ]
    for uav, paths in zip(formation.uavs, zip(*files, strict=True), strict=True):
        yield uav.sysid, {f: read_mission_file(path).plan.mission for f, path in zip(FORMATS, paths, strict=True)}


def _each_less(after: Sequence[FloatArray], before: Sequence[FloatArray]) -> list[FloatArray]:
    return [one - other for one, other in zip(after, before, strict=True)]


def _said(log: Path, sysid: int) -> list[Message]:
    """What a vehicle said, from its log of both directions."""
    return [message for _, message in read_tlog(log) if message.get_srcSystem() == sysid]


def _ignore(line: str) -> None:
    pass


def _show_nothing(statuses: list[VehicleStatus]) -> None:
    pass
