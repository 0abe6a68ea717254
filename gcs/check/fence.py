"""Whether a flight stays within its own fence: inside every area to stay in, outside every one to stay out of."""

import numpy as np
import numpy.typing as npt

from missions.fence import Fence, FenceCircle
from missions.frame import LocalFrame
from planner.proof.bracket import Least, even, least
from planner.proof.tracks import Tracks

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

WIDTH_M = 64.0
"""Of the first intervals."""


def room_m(tracks: Tracks, fence: Fence, area: int, frame: LocalFrame) -> Least:
    """How far the tracks keep on the allowed side of one area of a fence; negative beyond it, `at` arc lengths.

    Proven: the distance from an edge changes by no more than the way that is flown.
    """
    shape = fence.areas[area]
    sign = 1.0 if shape.inclusion else -1.0
    corners = [shape.center] if isinstance(shape, FenceCircle) else shape.vertices
    places = np.array([frame.from_e7(*corner) for corner in corners])

    def inside(row: IntArray, s_m: FloatArray) -> FloatArray:
        points = tracks.points(row, s_m)[:, :2]
        if isinstance(shape, FenceCircle):
            margin: FloatArray = shape.radius_m - np.hypot(*(points - places[0]).T)
        else:
            margin = _inside_polygon_m(points, places)
        return sign * margin

    def bounds(row: IntArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        start, end = inside(row, a), inside(row, b)
        return (start + end - (b - a)) / 2, np.minimum(start, end), np.where(start <= end, a, b)

    return least(len(tracks), even(np.zeros(len(tracks)), tracks.lengths_m, WIDTH_M), bounds, 0.0)


def _inside_polygon_m(points: FloatArray, vertices: FloatArray) -> FloatArray:
    """Distance of points (n, 2) from a polygon's edge; negative outside."""
    start, end = vertices, np.roll(vertices, -1, axis=0)
    edge = end - start
    from_start = points[:, None] - start
    along = np.clip(np.sum(from_start * edge, axis=-1) / np.maximum(np.sum(edge**2, axis=-1), 1e-12), 0.0, 1.0)
    away = np.linalg.norm(from_start - along[..., None] * edge, axis=-1).min(axis=1)
    spans = (start[:, 1] > points[:, 1, None]) != (end[:, 1] > points[:, 1, None])
    rise = np.where(edge[:, 1] == 0.0, 1.0, edge[:, 1])
    crosses = spans & (points[:, 0, None] < start[:, 0] + (points[:, 1, None] - start[:, 1]) / rise * edge[:, 0])
    result: FloatArray = np.where(crosses.sum(axis=1) % 2 == 1, away, -away)
    return result
