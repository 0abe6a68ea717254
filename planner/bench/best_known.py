"""The best paths that anyone has found: kept with how they were found, beaten when beaten."""

import json
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from planner.bench.problems import BenchProblem
from planner.cost.kernel import INFEASIBLE_KM, evaluate

FloatArray = npt.NDArray[np.float64]

PACKAGED = Path(__file__).with_name("best_known.json")
FORMAT = 1
DECIMALS = (3, 6, 9)
"""Of the metres in the file: as few as keep a path feasible; all 17 digits where none do."""
ROUNDING = 1e-6
"""How much of its value a path may lose to rounding."""


@dataclass(frozen=True)
class BestPath:
    """A best-known path.

    Attributes:
        problem, digest: which problem, and its content.
        value_km: cost of the path as kept here.
        waypoints: interior ones.
        method, evaluations, seed: how it was found.
        found: day and version, as "2026-01-31, skein 0.1.0".
        path_m: interior waypoints, flat.
    """

    problem: str
    digest: str
    value_km: float
    waypoints: int
    method: str
    evaluations: int
    seed: int
    found: str
    path_m: tuple[float, ...]


@dataclass(frozen=True)
class BestPlan:
    """A best-known plan of all vehicles of a scenario together.

    Attributes:
        scenario, digest: which, and its content.
        value_km: sum of all vehicles' costs.
        method, seed, found: as of a path.
        paths_m: each vehicle's interior waypoints, flat, in order of priority.
    """

    scenario: str
    digest: str
    value_km: float
    method: str
    seed: int
    found: str
    paths_m: tuple[tuple[float, ...], ...]


@dataclass
class BestKnown:
    """All of them by digest."""

    paths: dict[str, BestPath]
    plans: dict[str, BestPlan]

    def value_km(self, digest: str) -> float | None:
        """Cost of the best-known path or plan; None where there is none."""
        entry = self.paths.get(digest) or self.plans.get(digest)
        return entry.value_km if entry else None

    def offer(self, problem: BenchProblem, interior_m: FloatArray, *, method: str, evaluations: int, seed: int) -> bool:
        """Keep a path (3 waypoints,) if it is feasible and better than what is known; says whether it was."""
        kept_m, value_km = _rounded(problem, interior_m)
        known_km = self.value_km(problem.digest)
        if value_km >= INFEASIBLE_KM or (known_km is not None and value_km >= known_km):
            return False
        # What was known of an earlier content of that problem is of no more use.
        self.paths = {digest: path for digest, path in self.paths.items() if path.problem != problem.name}
        self.paths[problem.digest] = BestPath(
            problem=problem.name,
            digest=problem.digest,
            value_km=value_km,
            waypoints=problem.waypoints,
            method=method,
            evaluations=evaluations,
            seed=seed,
            found=found_now(),
            path_m=tuple(kept_m.tolist()),
        )
        return True

    def save(self, path: Path = PACKAGED) -> None:
        """Write the file, one entry a line. Raises OSError."""

        def lines(entries: list[Any]) -> str:
            return ",\n".join(json.dumps(asdict(entry), allow_nan=False) for entry in entries)

        paths = sorted(self.paths.values(), key=lambda entry: entry.problem)
        plans = sorted(self.plans.values(), key=lambda entry: entry.scenario)
        text = f'{{"format": {FORMAT},\n"paths": [\n{lines(paths)}\n],\n"plans": [\n{lines(plans)}\n]}}\n'
        unfinished = path.with_suffix(".part")
        unfinished.write_text(text, encoding="utf-8")
        unfinished.replace(path)


def load_best_known(path: Path = PACKAGED) -> BestKnown:
    """Read the file. Raises InputError when it is not one that this version reads, OSError when it is missing."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        if data["format"] != FORMAT:
            raise InputError(f"{path}: format {data['format']}, this version reads {FORMAT}")
        paths = [BestPath(**entry | {"path_m": tuple(entry["path_m"])}) for entry in data["paths"]]
        plans = [BestPlan(**entry | {"paths_m": tuple(map(tuple, entry["paths_m"]))}) for entry in data["plans"]]
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: not a file of best-known paths: {type(error).__name__} {error}") from None
    return BestKnown({entry.digest: entry for entry in paths}, {entry.digest: entry for entry in plans})


@lru_cache(maxsize=1)
def _packaged() -> BestKnown:
    return load_best_known()


def best_known(digest: str) -> float | None:
    """Cost in kilometres of the best-known path or plan of a problem with this digest; None where there is none.

    See `planner.bench.digest.problem_digest` for one vehicle and `planner.bench.together.plan_digest` for all.
    """
    return _packaged().value_km(digest)


def found_now() -> str:
    """Today and this version."""
    return f"{datetime.now(UTC).date()}, skein {version('skein-gcs')}"


def _rounded(problem: BenchProblem, interior_m: FloatArray) -> tuple[FloatArray, float]:
    """A path with as few digits as it bears, and what it then costs."""
    exact_km = float(evaluate(interior_m.reshape(1, -1), problem.problem, "graded")[0][0])
    for decimals in DECIMALS:
        kept = np.round(interior_m, decimals)
        cost = float(evaluate(kept.reshape(1, -1), problem.problem, "graded")[0][0])
        if cost <= exact_km * (1.0 + ROUNDING):
            return kept, cost
    return interior_m, exact_km
