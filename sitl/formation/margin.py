"""The delay margin: how late corrections may come before the formation rings (MODEL, section 6, Delay margin).

It is three numbers: `continuous`, of the bare law; `sampled`, of the law that acts once a tick; `aircraft`, with the
engine's lag and drag too, which is the one to quote for a flight.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from missions.airframe import Airframe
from sitl.formation.continuous_margin import continuous_margin
from sitl.formation.crossing import Crossing
from sitl.formation.linear_formation import LinearFormation, Mode, modes
from sitl.formation.plant import aircraft_plant, point_plant
from sitl.formation.sampled_margin import sampled_margin

Level = Literal["continuous", "sampled", "aircraft"]


@dataclass(frozen=True)
class ModeMargin:
    """A mode, and where it begins to grow at each level."""

    mode: Mode
    at: Mapping[Level, Crossing]

    def swing(self, level: Level) -> npt.NDArray[np.float64]:
        """Each vehicle's share of the energy of what swings at the margin, (n,); of several-fold modes the mean."""
        whole = self.mode.eigenvalue is None
        energy = self.at[level].swing ** 2 if whole else (self.mode.vectors**2).sum(axis=1)
        return np.asarray(energy / energy.sum())


def mode_margins(formation: LinearFormation, airframe: Airframe) -> list[ModeMargin]:
    """The margins of each mode of a formation, in order of lambda; none of a single vehicle."""
    point, aircraft, gains = point_plant(), aircraft_plant(airframe), formation.gains
    return [
        ModeMargin(
            mode,
            {
                "continuous": continuous_margin(mode, gains),
                "sampled": sampled_margin(mode, gains, point),
                "aircraft": sampled_margin(mode, gains, aircraft),
            },
        )
        for mode in modes(formation)
    ]


def limiting_mode(margins: Sequence[ModeMargin], level: Level) -> ModeMargin | None:
    """The mode that begins to grow first; None when every delay is stable."""
    limited = [margin for margin in margins if math.isfinite(margin.at[level].delay_s)]
    return min(limited, key=lambda margin: margin.at[level].delay_s, default=None)


def margin_s(margins: Sequence[ModeMargin], level: Level) -> float:
    """The delay at which the formation begins to ring; infinite when every delay is stable."""
    return min((margin.at[level].delay_s for margin in margins), default=math.inf)


def aircraft_margin_s(formation: LinearFormation, airframe: Airframe) -> float:
    """The margin of a formation of aircraft; infinite when every delay is stable."""
    plant = aircraft_plant(airframe)
    delays = (sampled_margin(mode, formation.gains, plant).delay_s for mode in modes(formation))
    return min(delays, default=math.inf)
