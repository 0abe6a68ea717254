"""A polyline in the plane whose corners are rounded by arcs.

`path_at` keeps to the dialect that plain Python and numba compute bit for bit alike.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

SHORTEST_LEG_M = 0.01
"""Legs below this join two corners into one: the wire's own resolution is 1.1 cm."""
SHARPEST_ARC_M = 1.0
"""Arcs that only fit with a smaller radius are left as a sharp corner."""


@dataclass(frozen=True)
class Arc:
    """An arc that leads into a path: where it starts, heading there, curvature (positive to the left), length."""

    x_m: float
    y_m: float
    heading: float
    curvature: float
    length_m: float


@dataclass(frozen=True)
class FilletedPath:
    """A filleted polyline.

    Attributes:
        segments: (n, 5): arc length at the start, x, y, heading, curvature (0 on straights), SI and radians.
        length_m: arc length of the whole.
        corner_s_m: (m,) arc length at each corner of the polyline: 0, the middle of each arc, the length.
        corner_radius_m: (m,) radius of the arc at each corner; infinite where the path does not turn.
        corner_turn: (m,) change of heading at each corner, radians, positive to the left.
    """

    segments: FloatArray
    length_m: float
    corner_s_m: FloatArray
    corner_radius_m: FloatArray
    corner_turn: FloatArray

    def at(self, s_m: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """x, y, heading and curvature at arc lengths of any shape; beyond the ends the path goes on straight."""
        index = np.clip(np.searchsorted(self.segments[:, 0], s_m, side="right") - 1, 0, len(self.segments) - 1)
        start, x0, y0, heading0, curvature = np.moveaxis(self.segments[index], -1, 0)
        along = s_m - start
        heading = heading0 + curvature * along
        chord_angle = 0.5 * curvature * along
        chord = along * np.sinc(chord_angle / np.pi)
        x = x0 + chord * np.cos(heading0 + chord_angle)
        y = y0 + chord * np.sin(heading0 + chord_angle)
        return x, y, heading, curvature

    def after(self, arc: Arc) -> "FilletedPath":
        """The path with an arc before it; its first corner is then the arc's start."""
        segments = self.segments.copy()
        segments[:, 0] += arc.length_m
        first = [0.0, arc.x_m, arc.y_m, arc.heading, arc.curvature]
        corner_s_m = self.corner_s_m + arc.length_m
        corner_s_m[0] = 0.0
        return replace(
            self,
            segments=np.vstack([first, segments]),
            length_m=self.length_m + arc.length_m,
            corner_s_m=corner_s_m,
        )


def path_at(s_m: float, index: int, segments: Any) -> tuple[float, float, float, float, int]:
    """x, y, heading, curvature at arc length s, and the index of its segment, found from a nearby one.

    `segments` as in `FilletedPath`, indexed as segments[i][j]. Before the start and past the end the first and last
    segments go on.
    """
    while index + 1 < len(segments) and s_m >= segments[index + 1][0]:
        index += 1
    while index > 0 and s_m < segments[index][0]:
        index -= 1
    row = segments[index]
    along = s_m - row[0]
    heading = row[3]
    curvature = row[4]
    if curvature == 0.0:
        return row[1] + along * math.cos(heading), row[2] + along * math.sin(heading), heading, 0.0, index
    turned = heading + curvature * along
    x = row[1] + (math.sin(turned) - math.sin(heading)) / curvature
    y = row[2] - (math.cos(turned) - math.cos(heading)) / curvature
    return x, y, turned, curvature, index


def fillet(corners_m: FloatArray, radius_m: float) -> FilletedPath:
    """Round the corners of a polyline.

    Each arc has `radius_m`, or the largest radius whose tangents fit in half of the legs beside it (all of the first
    and the last leg, where no other arc needs room).

    Args:
        corners_m: (m, 2), m >= 2. Legs shorter than `SHORTEST_LEG_M` are skipped.
        radius_m: wanted radius of every arc.

    Raises:
        ValueError: all corners are in one place.
    """
    kept = [0]
    for i in range(1, len(corners_m)):
        if math.dist(corners_m[i], corners_m[kept[-1]]) >= SHORTEST_LEG_M:
            kept.append(i)
    if len(kept) < 2:
        raise ValueError("a path needs two corners apart from each other")
    points = corners_m[kept]
    legs = np.diff(points, axis=0)
    lengths = np.hypot(legs[:, 0], legs[:, 1])
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    turns = (np.diff(headings) + np.pi) % (2 * np.pi) - np.pi

    # Plain numbers from here on: numpy's take several times as long one by one.
    across, heading, turn = lengths.tolist(), headings.tolist(), turns.tolist()
    at, direction = points.tolist(), (legs / lengths[:, None]).tolist()
    rows: list[tuple[float, float, float, float, float]] = []
    kept_s = [0.0]
    kept_radius = [math.inf]
    s = 0.0
    cut_before = 0.0  # how much of the present leg the arc at its start has used
    last = len(legs) - 1
    for i in range(len(legs)):
        cut_after, radius = 0.0, math.inf
        if i < last and turn[i] != 0.0:
            room = min(across[i] if i == 0 else across[i] / 2, across[i + 1] if i + 1 == last else across[i + 1] / 2)
            half_tangent = math.tan(abs(turn[i]) / 2)
            radius = min(radius_m, room / half_tangent)
            cut_after = radius * half_tangent if radius >= SHARPEST_ARC_M else 0.0
        ahead_x, ahead_y = direction[i]
        straight = across[i] - cut_before - cut_after
        if straight > 0.0 or not rows:
            rows.append((s, at[i][0] + ahead_x * cut_before, at[i][1] + ahead_y * cut_before, heading[i], 0.0))
        s += max(straight, 0.0)
        if cut_after > 0.0:
            entry_x, entry_y = at[i + 1][0] - ahead_x * cut_after, at[i + 1][1] - ahead_y * cut_after
            arc = radius * abs(turn[i])
            rows.append((s, entry_x, entry_y, heading[i], math.copysign(1 / radius, turn[i])))
            kept_s.append(s + arc / 2)
            s += arc
        else:
            kept_s.append(s)
        kept_radius.append(radius if radius >= SHARPEST_ARC_M else 0.0)
        cut_before = cut_after
    # Past the end the path goes on straight, whatever the last segment was.
    rows.append((s, at[-1][0], at[-1][1], heading[-1], 0.0))

    corner_of = np.searchsorted(kept, np.arange(len(corners_m)), side="right") - 1
    return FilletedPath(
        segments=np.array(rows),
        length_m=s,
        corner_s_m=np.array(kept_s)[corner_of],
        corner_radius_m=np.array(kept_radius)[corner_of],
        corner_turn=np.concatenate([[0.0], turns, [0.0]])[corner_of],
    )
