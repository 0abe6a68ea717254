"""Ground that was measured: heights at the posts of a regular grid, bilinear in between.

Beyond the outermost posts the ground goes on level. `raster_height_and_slope` keeps to the dialect that plain Python
and numba compute bit for bit alike.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from missions.environment.terrain import Terrain

FloatArray = npt.NDArray[np.float64]


class Raster(NamedTuple):
    """Heights at the posts of a grid.

    Attributes:
        posts: (ny, nx) float64, at least 2 by 2, metres above the datum; rows from south to north.
        x0_m, y0_m: where posts[0, 0] stands.
        spacing_x_m, spacing_y_m: between neighbouring posts.
    """

    posts: FloatArray
    x0_m: float
    y0_m: float
    spacing_x_m: float
    spacing_y_m: float


NO_POSTS: FloatArray = np.zeros((0, 0))
BLOCK_CELLS = 8
"""Cells along the side of a block, of which `block_tops` holds the highest post."""


def cell_and_share(position: float, last: int) -> tuple[int, float, float]:
    """The cell that a position on an axis lies in, in cells from the first post to post `last`.

    Returns:
        the cell's number; where in it the position lies, 0 to 1; and 1 where the ground follows the position, 0 beyond
        the outermost posts, where it is level.
    """
    if not position > 0.0:
        return 0, 0.0, 0.0
    if position >= last:
        return last - 1, 1.0, 0.0
    cell = int(position)
    return cell, position - cell, 1.0


def raster_height_and_slope(x_m: float, y_m: float, terrain: "Raster | Terrain") -> tuple[float, float, float]:
    """Height at one point, metres, and its derivatives by x and y; at the seam of two cells those of the later one."""
    posts = terrain.posts
    i, u, along_x = cell_and_share((x_m - terrain.x0_m) / terrain.spacing_x_m, posts.shape[1] - 1)
    j, v, along_y = cell_and_share((y_m - terrain.y0_m) / terrain.spacing_y_m, posts.shape[0] - 1)
    corner = float(posts[j, i])
    east = float(posts[j, i + 1]) - corner
    north = float(posts[j + 1, i]) - corner
    twist = float(posts[j + 1, i + 1]) - corner - east - north
    height = corner + east * u + north * v + twist * u * v
    slope_x = along_x * (east + twist * v) / terrain.spacing_x_m
    slope_y = along_y * (north + twist * u) / terrain.spacing_y_m
    return height, slope_x, slope_y


def raster_heights_m(x_m: FloatArray, y_m: FloatArray, terrain: "Raster | Terrain") -> FloatArray:
    """Heights at arrays of points of any one shape, metres; vectorised with numpy."""
    posts = np.asarray(terrain.posts)
    ny, nx = posts.shape
    u = np.clip((np.asarray(x_m) - terrain.x0_m) / terrain.spacing_x_m, 0.0, nx - 1.0)
    v = np.clip((np.asarray(y_m) - terrain.y0_m) / terrain.spacing_y_m, 0.0, ny - 1.0)
    i = np.minimum(u.astype(np.int64), nx - 2)
    j = np.minimum(v.astype(np.int64), ny - 2)
    u, v = u - i, v - j
    below = posts[j, i] + (posts[j, i + 1] - posts[j, i]) * u
    above = posts[j + 1, i] + (posts[j + 1, i + 1] - posts[j + 1, i]) * u
    heights: FloatArray = below + (above - below) * v
    return heights


def block_tops(posts: FloatArray) -> FloatArray:
    """The highest post of each block of `BLOCK_CELLS` by `BLOCK_CELLS` cells, its edges included.

    Args:
        posts: (ny, nx).

    Returns:
        (ceil((ny - 1) / BLOCK_CELLS), ceil((nx - 1) / BLOCK_CELLS)).
    """
    tops = posts
    for axis in (0, 1):
        cells = tops.shape[axis] - 1
        first = np.arange(0, cells, BLOCK_CELLS)
        edges = np.take(tops, np.minimum(first + BLOCK_CELLS, cells), axis=axis)
        tops = np.maximum(np.maximum.reduceat(tops, first, axis=axis), edges)
    return tops


def raster_slope_bound(terrain: "Raster | Terrain") -> float:
    """The steepest slope of any cell: in a cell |grad Z|^2 is convex, so it is largest at one of the corners."""
    posts = np.asarray(terrain.posts)
    along_x = (np.diff(posts, axis=1) / terrain.spacing_x_m) ** 2
    along_y = (np.diff(posts, axis=0) / terrain.spacing_y_m) ** 2
    steepest = np.maximum(along_x[:-1], along_x[1:]) + np.maximum(along_y[:, :-1], along_y[:, 1:])
    return float(np.sqrt(steepest.max()))
