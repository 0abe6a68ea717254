"""A campaign: every combination of its axes' values, flown with every seed."""

import hashlib
import itertools
import json
import platform
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numba
import numpy as np

from gcs.campaign.axes import Axes
from gcs.campaign.case import Case, own_sources
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


@dataclass(frozen=True)
class Campaign:
    """What is flown.

    Attributes:
        scenario, plan: of every flight; the axes' values replace the scenario's.
        axes: what varies besides the seed.
        seeds: of the gusts.
    """

    scenario: Scenario
    plan: FormationPlan
    axes: Axes
    seeds: range

    def settings(self) -> Iterator[tuple[tuple[str, Any], ...]]:
        """Every combination of the axes' values, as `Case.values`."""
        for values in itertools.product(*self.axes.values()):
            yield tuple(zip(self.axes, values, strict=True))

    def cases(self) -> Iterator[Case]:
        """Every flight, seed by seed: a campaign that is cut short has tried all combinations."""
        for seed in self.seeds:
            for values in self.settings():
                yield Case(values, seed)

    def identity(self) -> dict[str, Any]:
        """What must be the same for rows to belong into one table: JSON values. Seeds and values may be added."""
        raster = self.scenario.raster
        ground = hashlib.sha256(b"" if raster is None else b"".join(np.asarray(part).tobytes() for part in raster))
        missions = [[uav.sysid, [asdict(item) for item in uav.mission]] for uav in self.plan.uavs]
        return {
            "scenario": _sha256(self.scenario.model_dump(mode="json")),
            "ground": ground.hexdigest(),
            "plan": _sha256(missions),
            "axes": list(self.axes),
            "sources": own_sources(),
            "python": platform.python_version(),
            "numpy": np.__version__,
            "numba": numba.__version__,
        }


def _sha256(values: Any) -> str:
    return hashlib.sha256(json.dumps(values).encode()).hexdigest()
