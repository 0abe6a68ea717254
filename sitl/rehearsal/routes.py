"""What a swarm flies, as the kernel reads it."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.mission import Mission
from sitl.captain import Captain
from sitl.config import VehicleConfig
from sitl.parameters import Parameters, arduplane_parameters
from sitl.places import from_tick, what_losses_lead_to
from sitl.rehearsal.kernel import Routes
from sitl.stages.path import PathStage
from sitl.store import Store


def routes_of(vehicles: Sequence[VehicleConfig], missions: Mapping[int, Mission]) -> Routes:
    """The missions of vehicles as tables, built as their endpoints build them, and the places that they change to.

    Raises:
        InputError: a mission cannot be flown, or is not one path with a loiter at its end; it names the vehicle.
    """
    stages = [_stage(vehicle, missions[vehicle.sysid]) for vehicle in vehicles]
    rows, changes = {vehicle.sysid: p for p, vehicle in enumerate(vehicles)}, []
    for move in sorted(what_losses_lead_to(vehicles[0]).moves, key=from_tick):
        row = rows[move.sysid]
        ended = _stage(vehicles[row], move.mission)
        changes.append((from_tick(move), row, len(stages)))
        stages.append(stages[row].onto(move.reference, ended, 0.0))
    tables = [stage.tables for stage in stages]
    segments, first_segment = _stacked([one.segments for one in tables])
    altitude, first_altitude = _stacked([one.altitude for one in tables])
    schedule, first_schedule = _stacked([one.schedule for one in tables])
    airspeeds, first_airspeed = _stacked([one.airspeeds for one in tables])
    return Routes(
        segments,
        first_segment,
        altitude,
        first_altitude,
        schedule,
        first_schedule,
        airspeeds,
        first_airspeed,
        length_m=np.array([one.length_m for one in tables]),
        duration_s=np.array([one.duration_s for one in tables]),
        end_s_m=np.array([stage.reference.path.corner_s_m[-1] for stage in stages]),
        circle=np.array([stage.final_loiter() for stage in stages]),
        home_m=np.array([_captain(vehicle).home_m for vehicle in vehicles]),
        changes=np.array(changes, dtype=np.int64).reshape(-1, 3),
    )


def _stage(vehicle: VehicleConfig, mission: Mission) -> PathStage:
    captain = _captain(vehicle)
    try:
        stage = captain.planned(mission.with_home(captain.home)).first_stage
    except InputError as error:
        raise InputError(f"vehicle {vehicle.sysid}: {error}") from None
    if not isinstance(stage, PathStage) or stage.loiter_seq is None:
        raise InputError(f"vehicle {vehicle.sysid}: a rehearsal flies waypoints with a loiter at the end, nothing else")
    return stage


def _captain(vehicle: VehicleConfig) -> Captain:
    return Captain(vehicle, Parameters(arduplane_parameters(vehicle.sysid, vehicle.airframe), Store()), lambda _: None)


def _stacked(tables: Sequence[Any]) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Tables one below the other, and the row at which each begins, with the end of the last."""
    arrays = [np.array(table, dtype=np.float64) for table in tables]
    return np.vstack(arrays), np.concatenate([[0], np.cumsum([len(array) for array in arrays])]).astype(np.int64)
