"""What was planned and flown, as few enough points to draw, and the part of the area that they cover."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.metrics.arrival import arrival
from gcs.truth import H, Truths, X
from missions.environment import Environment, ground_heights_m
from missions.reference import Reference

FloatArray = npt.NDArray[np.float64]

POINTS = 1500
"""Of one path."""
GROUND_CELLS = 160
"""Of the drawn ground, along its longer side."""
LEVEL_M = 1.0
"""Ground that rises no more than this is level."""
MARGIN = 0.1
"""Around what is drawn, as a share of its longer side."""


@dataclass(frozen=True)
class Ground:
    """Heights of the ground over what is drawn: axes (n,) and (m,), heights (m, n). Metres."""

    x_m: FloatArray
    y_m: FloatArray
    z_m: FloatArray

    @property
    def extent_m(self) -> tuple[float, float, float, float]:
        """x from and to, y from and to."""
        return float(self.x_m[0]), float(self.x_m[-1]), float(self.y_m[0]), float(self.y_m[-1])

    @property
    def level(self) -> bool:
        """Whether there is nothing to shade."""
        return float(np.ptp(self.z_m)) < LEVEL_M


def planned_paths(references: Mapping[int, Reference]) -> dict[int, FloatArray]:
    """Each vehicle's filleted path, (n, 3), by sysid."""
    return {sysid: one.points(np.linspace(0.0, one.length_m, POINTS)) for sysid, one in references.items()}


def flown_paths(truths: Truths, references: Mapping[int, Reference]) -> dict[int, FloatArray]:
    """What each vehicle flew until its arrival, (n, 3), by sysid; without the loiter that follows."""
    paths = {}
    for sysid, truth in truths.items():
        last = arrival(truth, references[sysid]).tick
        rows = len(truth) if last is None else last + 1
        kept = np.unique(np.linspace(0, rows - 1, POINTS).astype(np.int64))
        paths[sysid] = truth[kept, X : H + 1]
    return paths


def ground_below(paths: Mapping[int, FloatArray], environment: Environment) -> Ground:
    """The ground under all paths, radars and obstacles."""
    points = np.concatenate([path[:, :2] for path in paths.values()])
    low, high = points.min(axis=0), points.max(axis=0)
    circles = [(radar.x_m, radar.y_m, radar.radius_m) for radar in environment.radars]
    circles += [(obstacle.x_m, obstacle.y_m, obstacle.radius_m) for obstacle in environment.obstacles]
    for centre_x, centre_y, radius in circles:
        low = np.minimum(low, (centre_x - radius, centre_y - radius))
        high = np.maximum(high, (centre_x + radius, centre_y + radius))
    longer = float((high - low).max())
    low, high = low - MARGIN * longer, high + MARGIN * longer
    terrain = environment.terrain
    if len(terrain.posts):  # beyond the raster nothing is known of the ground
        corner, spacing = np.array([terrain.x0_m, terrain.y0_m]), (terrain.spacing_x_m, terrain.spacing_y_m)
        low = np.maximum(low, corner)
        high = np.minimum(high, corner + np.array(spacing) * (np.array(terrain.posts.shape[::-1]) - 1))
    cells = np.maximum(2, np.ceil(GROUND_CELLS * (high - low) / (high - low).max())).astype(int)
    x, y = (np.linspace(low[i], high[i], cells[i]) for i in (0, 1))
    return Ground(x, y, ground_heights_m(*np.meshgrid(x, y), terrain))
