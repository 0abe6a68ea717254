"""How high a leg passes above a raster of heights, exactly.

Inside a cell the ground is bilinear, so along a straight line it is a quadratic, and so is the height above it: its
least value is at an end or at its vertex. Whole blocks of cells whose highest post lies too low to matter are passed
over.
"""

import math
from typing import Any

from missions.compiled import jit
from missions.environment.raster import BLOCK_CELLS


@jit
def least_height_above_raster_m(
    p: Any, q: Any, z0_m: float, z1_m: float, t0: float, t1: float, terrain: Any
) -> tuple[float, float]:
    """Least height above the ground on the part of a line from t0 to t1, metres, and the t at which it is reached.

    Args:
        p, q: the line's ends in plan, at t = 0 and t = 1.
        z0_m, z1_m: its heights there.
        t0, t1: the part that counts, 0 <= t0 <= t1 <= 1.
        terrain: with posts.
    """
    posts, tops = terrain.posts, terrain.tops
    last_i, last_j = tops.shape[1] - 1, tops.shape[0] - 1
    width, height = BLOCK_CELLS * terrain.spacing_x_m, BLOCK_CELLS * terrain.spacing_y_m
    u, v, dz = (p[0] - terrain.x0_m) / width, (p[1] - terrain.y0_m) / height, z1_m - z0_m
    du, dv = (q[0] - p[0]) / width, (q[1] - p[1]) / height
    i, j = _cell(u + t0 * du, 0, last_i), _cell(v + t0 * dv, 0, last_j)
    out_u, out_v = _way_out(u, du, i, 0, last_i), _way_out(v, dv, j, 0, last_j)
    line = u * BLOCK_CELLS, v * BLOCK_CELLS, z0_m, du * BLOCK_CELLS, dv * BLOCK_CELLS, dz
    least, place = _least_over_cells_m(line, t0, t0, posts)
    at_end, _ = _least_over_cells_m(line, t1, t1, posts)
    if at_end < least:
        least, place = at_end, t1
    start = t0
    while True:
        end = max(start, _first(out_u, out_v, t1))
        if z0_m + (start if dz > 0.0 else end) * dz - tops[j, i] < least:
            inside, t = _least_over_cells_m(line, start, end, posts)
            if inside < least:
                least, place = inside, t
        if end >= t1:
            return least, place
        if out_u <= out_v:
            i += 1 if du > 0.0 else -1
            out_u = _way_out(u, du, i, 0, last_i)
        else:
            j += 1 if dv > 0.0 else -1
            out_v = _way_out(v, dv, j, 0, last_j)
        start = end


@jit
def _least_over_cells_m(line: Any, t0: float, t1: float, posts: Any) -> tuple[float, float]:
    """The same, cell by cell, for a line (u, v, z) + t (du, dv, dz) with u and v in cells.

    The level ground beyond the outermost posts is cells -1 and n - 1, whose two sides are the same posts.
    """
    u, v, z, du, dv, dz = line
    last_i, last_j = posts.shape[1] - 1, posts.shape[0] - 1
    i, j = _cell(u + t0 * du, -1, last_i), _cell(v + t0 * dv, -1, last_j)
    out_u, out_v = _way_out(u, du, i, -1, last_i), _way_out(v, dv, j, -1, last_j)
    least: float = math.inf
    start = t0
    while True:
        end = max(start, _first(out_u, out_v, t1))
        west, east, south, north = max(i, 0), min(i + 1, last_i), max(j, 0), min(j + 1, last_j)
        corner = posts[south, west]
        slope_u, slope_v = posts[south, east] - corner, posts[north, west] - corner
        twist = posts[north, east] - corner - slope_u - slope_v
        a, b = u + start * du - i, v + start * dv - j
        height = z + start * dz - (corner + slope_u * a + slope_v * b + twist * a * b)
        rate = dz - slope_u * du - slope_v * dv - twist * (a * dv + b * du)
        bend = -twist * du * dv
        length = end - start
        if height < least:
            least, place = height, start
        at_end = height + length * (rate + length * bend)
        if at_end < least:
            least, place = at_end, end
        if rate < 0.0 and rate + 2.0 * bend * length > 0.0:
            at_vertex = height - rate * rate / (4.0 * bend)
            if at_vertex < least:
                least, place = at_vertex, start - rate / (2.0 * bend)
        if end >= t1:
            return least, place
        if out_u <= out_v:
            i += 1 if du > 0.0 else -1
            out_u = _way_out(u, du, i, -1, last_i)
        else:
            j += 1 if dv > 0.0 else -1
            out_v = _way_out(v, dv, j, -1, last_j)
        start = end


@jit
def _cell(position: float, first: int, last: int) -> int:
    """The cell that a position lies in; the first and the last go on for ever."""
    if not position >= first + 1:
        return first
    if position >= last:
        return last
    return math.floor(position)


@jit
def _way_out(position: float, rate: float, cell: int, first: int, last: int) -> float:
    """The t at which position + t rate leaves a cell; infinite when it never does."""
    if rate > 0.0 and cell < last:
        return (cell + 1 - position) / rate
    if rate < 0.0 and cell > first:
        return (cell - position) / rate
    return math.inf


@jit
def _first(out_u: float, out_v: float, t1: float) -> float:
    """The first of three times; a position that is no number has no way out."""
    end = t1
    if out_u < end:
        end = out_u
    if out_v < end:
        end = out_v
    return end
