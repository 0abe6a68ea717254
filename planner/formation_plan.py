"""The planner's result: one path and mission a UAV, with what they cost. Kept as plan.json."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.reference import Reference, build_reference
from missions.scenario import Scenario

FORMAT = 2
"""Version of plan.json."""


@dataclass(frozen=True)
class FitnessTerms:
    """The terms of the objective (3), kilometres."""

    length: float
    terrain: float
    radar: float
    collision: float
    altitude: float

    @property
    def fitness(self) -> float:
        """f of equation (3)."""
        return self.length + self.terrain + self.radar + self.collision + self.altitude


@dataclass(frozen=True)
class UavPlan:
    """One UAV's part of a plan.

    Attributes:
        sysid, name: of the vehicle that flies it.
        waypoints_m: (n + 1, 3) corners of the path, origin and target included, local frame.
        terms: of the objective, for the polyline through the waypoints.
        straight_line_m: from origin to target, the bound that no path is shorter than.
        length_m: of the filleted path, climb included.
        evaluations: of the objective that the search used (0 for a slot).
        history: evaluations and the best cost after so many, kilometres; None while there is no feasible one.
        mission: what the vehicle is told.
    """

    sysid: int
    name: str
    waypoints_m: npt.NDArray[np.float64]
    terms: FitnessTerms
    straight_line_m: float
    length_m: float
    evaluations: int
    history: tuple[tuple[int, float | None], ...]
    mission: Mission


@dataclass(frozen=True)
class FormationPlan:
    """A plan for all vehicles of a scenario, in order of priority (the scenario's order).

    Attributes:
        scenario: name of the scenario.
        seed: of the search and of the flight's gusts.
        method: of the search, or "slots".
        uavs: one a vehicle.
        compile_s, plan_s: wall time of compilation and of planning without it.
        slot_scale: for each corner of the route of slots, what their sideways offsets are multiplied by to fit.
        slot_stagger: how they pass it: 0 as in their pattern, 1 staggered, 2 in single file.
    """

    scenario: str
    seed: int
    method: str
    uavs: tuple[UavPlan, ...]
    compile_s: float
    plan_s: float
    slot_scale: tuple[float, ...] = ()
    slot_stagger: tuple[int, ...] = ()

    @property
    def missions(self) -> dict[int, Mission]:
        """What each vehicle is told, by sysid."""
        return {uav.sysid: uav.mission for uav in self.uavs}

    def references(self, scenario: Scenario) -> dict[int, Reference]:
        """The reference of each vehicle by sysid, built from its mission as an endpoint builds it."""
        airframe, forecast = scenario.airframe.airframe(), scenario.wind.forecast_m_s
        return {uav.sysid: build_reference(uav.mission, scenario.frame, airframe, forecast) for uav in self.uavs}

    def save(self, path: Path) -> None:
        """Write plan.json. Raises OSError."""
        path.write_text(json.dumps(self.as_json(), indent=1, allow_nan=False) + "\n", encoding="utf-8")

    def as_json(self) -> dict[str, Any]:
        """The plan as JSON values."""
        return {
            "format": FORMAT,
            "scenario": self.scenario,
            "seed": self.seed,
            "method": self.method,
            "compile_s": self.compile_s,
            "plan_s": self.plan_s,
            "slot_scale": list(self.slot_scale),
            "slot_stagger": list(self.slot_stagger),
            "uavs": [
                {
                    "sysid": uav.sysid,
                    "name": uav.name,
                    "fitness": uav.terms.fitness,
                    "fitness_terms": asdict(uav.terms),
                    "straight_line_m": uav.straight_line_m,
                    "length_m": uav.length_m,
                    "evaluations": uav.evaluations,
                    "history": [list(entry) for entry in uav.history],
                    "waypoints_m": uav.waypoints_m.tolist(),
                    "mission": [asdict(item) for item in uav.mission],
                }
                for uav in self.uavs
            ],
        }


def load_plan(path: Path) -> FormationPlan:
    """Read plan.json.

    Raises:
        InputError: the file is missing or is not a plan that this version reads.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; `skein plan` makes a run") from None
    except ValueError as error:
        raise InputError(f"{path}: not JSON: {error}") from None
    try:
        if data["format"] != FORMAT:
            raise InputError(f"{path}: format {data['format']}, this version reads {FORMAT}; plan it again")
        return FormationPlan(
            scenario=data["scenario"],
            seed=data["seed"],
            method=data["method"],
            uavs=tuple(_uav(entry) for entry in data["uavs"]),
            compile_s=data["compile_s"],
            plan_s=data["plan_s"],
            slot_scale=tuple(data.get("slot_scale", ())),
            slot_stagger=tuple(data.get("slot_stagger", ())),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: not a plan: {type(error).__name__} {error}; plan it again") from None


def _uav(entry: dict[str, Any]) -> UavPlan:
    return UavPlan(
        sysid=entry["sysid"],
        name=entry["name"],
        waypoints_m=np.array(entry["waypoints_m"], dtype=np.float64).reshape(-1, 3),
        terms=FitnessTerms(**entry["fitness_terms"]),
        straight_line_m=entry["straight_line_m"],
        length_m=entry["length_m"],
        evaluations=entry["evaluations"],
        history=tuple((int(evaluations), cost) for evaluations, cost in entry["history"]),
        mission=Mission(tuple(MissionItem(**item) for item in entry["mission"])),
    )
