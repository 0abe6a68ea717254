"""A study of a formation's delay margin: what `skein margin` says, and why."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from missions.airframe import Airframe
from missions.errors import InputError
from missions.scenario.network import FormationModel
from sitl.formation.damping import decay_rate
from sitl.formation.graph import edges
from sitl.formation.linear_formation import LinearFormation, common_mode, evenly_pinned, linear_formation, modes
from sitl.formation.margin import Level, ModeMargin, aircraft_margin_s, limiting_mode, margin_s, mode_margins
from sitl.formation.plant import aircraft_rates
from sitl.formation.suggested_gains import suggested_gains
from sitl.formation.topology import parts
from sitl.ticks import TICK_S, delay_ticks

LEVELS: tuple[Level, ...] = ("continuous", "sampled", "aircraft")
STANDSTILL = 1e-9
"""A rate (1/s) so small is none."""


@dataclass(frozen=True)
class MarginStudy:
    """What is studied.

    Attributes:
        model: graph, gains and pins.
        sysids: of the vehicles.
        airframe: of each.
        delay_s: at which gains are suggested; rounded up to whole ticks.
        bare: the law (15) itself, with unit weights, instead of the one that is flown.
    """

    model: FormationModel
    sysids: Sequence[int]
    airframe: Airframe
    delay_s: float
    bare: bool

    def figures(self) -> dict[str, Any]:
        """Everything that is known, as plain values; a margin is None when every delay is stable.

        Raises:
            InputError: nobody hears anybody, or the graph is not connected.
        """
        formation = self._formation()
        delay_s = delay_ticks(self.delay_s) * TICK_S
        margins = mode_margins(formation, self.airframe)
        suggested = suggested_gains(formation, self.airframe, delay_s)
        better = replace(formation, gains=suggested)
        level: Level = "continuous" if self.bare else "aircraft"
        return {
            "law": "bare" if self.bare else "flown",
            "graph": self.model.graph if isinstance(self.model.graph, str) else "edges",
            "vehicles": list(self.sysids),
            "edges": [list(edge) for edge in edges(self.model.graph, self.sysids)],
            "weights": "1" if self.bare else "1/max(d)",
            "pinned": [sysid for sysid in self.sysids if self.model.is_pinned(sysid)],
            "eigenvalues": [max(0.0, round(float(x), 12)) for x in np.linalg.eigvalsh(formation.laplacian)],
            **{f"{one}_s": _finite(margin_s(margins, one)) for one in LEVELS},
            "modes": [_mode(margin) for margin in margins],
            "limiting_mode": self._limiting(margins, level),
            "tick_s": TICK_S,
            "delay_s": delay_s,
            "gains": formation.gains._asdict(),
            "suggested_gains": suggested._asdict(),
            "damping": {
                "present": self._damping(formation, delay_s, margin_s(margins, "aircraft")),
                "suggested": self._damping(better, delay_s, aircraft_margin_s(better, self.airframe)),
            },
        }

    def _formation(self) -> LinearFormation:
        if len(self.sysids) < 2:
            raise InputError("a single vehicle hears nobody, so that no delay matters; study two or more")
        apart = parts(self.sysids, edges(self.model.graph, self.sysids))
        if len(apart) > 1:
            groups = " | ".join(", ".join(map(str, part)) for part in apart)
            raise InputError(
                f"formation.graph: not connected (lambda_2 = 0), its parts are {groups}; join them with edges"
            )
        return linear_formation(self.model, self.sysids, bare=self.bare)

    def _limiting(self, margins: Sequence[ModeMargin], level: Level) -> dict[str, Any] | None:
        margin = limiting_mode(margins, level)
        if margin is None:
            return None
        w = margin.at[level].frequency_rad_s
        return {
            "of": level,
            "eigenvalue": margin.mode.eigenvalue,
            "multiplicity": margin.mode.multiplicity,
            "margin_s": margin.at[level].delay_s,
            "frequency_rad_s": _finite(w),
            "swing": {str(sysid): float(x) for sysid, x in zip(self.sysids, margin.swing(level), strict=True)},
        }

    def _damping(self, formation: LinearFormation, delay_s: float, aircraft_s: float) -> dict[str, float | None]:
        """At a delay: rates of what moves vehicles against each other and of what moves all alike, and the margin."""
        even, rates = evenly_pinned(formation), aircraft_rates(self.airframe)
        apart = decay_rate(modes(even), formation.gains, rates, delay_s)
        together = decay_rate([common_mode(even)], formation.gains, rates, delay_s)
        return {
            "decay_rate_per_s": apart,
            "decay_time_s": 1.0 / apart if apart > STANDSTILL else None,
            "common_decay_time_s": 1.0 / together if together > STANDSTILL else None,
            "aircraft_s": _finite(aircraft_s),
        }


def _mode(margin: ModeMargin) -> dict[str, Any]:
    return {
        "eigenvalue": margin.mode.eigenvalue,
        "multiplicity": margin.mode.multiplicity,
        **{f"{level}_s": _finite(margin.at[level].delay_s) for level in LEVELS},
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
