"""A piecewise linear function averaged over a moving window: piecewise quadratic, with a continuous slope.

Altitude over arc length (window 120 m) and arc length over time (window 8 s) are both of this form (MODEL, section 6).
`quadratic_at` keeps to the dialect that plain Python and numba compute bit for bit alike.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def moving_average(knots: FloatArray, values: FloatArray, window: float) -> FloatArray:
    """The mean of the piecewise linear function over [u - window/2, u + window/2], as quadratic pieces.

    Outside its knots the function goes on with its end slopes, so that a single line is its own average.

    Args:
        knots: (n,) strictly rising, n >= 2.
        values: (n,).
        window: width of the average, > 0.

    Returns:
        (m, 4): start u0 of each piece and c0, c1, c2 of c0 + c1 (u - u0) + c2 (u - u0)^2. The first piece also holds
        before its start, the last one for ever.
    """
    slopes = np.diff(values) / np.diff(knots)
    inner = knots[1:-1]
    starts = np.sort(np.concatenate([[knots[0] - window], inner - window / 2, inner + window / 2]))
    starts = starts[np.append(True, np.diff(starts) > 0.0)]  # np.unique's first use would import numpy.ma: 20 ms

    def linear(u: FloatArray) -> FloatArray:
        index = np.clip(np.searchsorted(knots, u, side="right") - 1, 0, len(slopes) - 1)
        result: FloatArray = values[index] + slopes[index] * (u - knots[index])
        return result

    mean_slopes = (linear(starts + window / 2) - linear(starts - window / 2)) / window
    steps = np.diff(starts)
    bends = np.append(np.diff(mean_slopes) / (2 * steps), 0.0)
    # The first piece lies wholly on the first line, where the mean is the function itself.
    rises = mean_slopes[:-1] * steps + bends[:-1] * steps**2
    means = linear(starts[:1]) + np.concatenate([[0.0], np.cumsum(rises)])
    return np.column_stack([starts, means, mean_slopes, bends])


def quadratic_at(u: float, index: int, pieces: Any) -> tuple[float, float, float, int]:
    """Value, first and second derivative at u, and the index of its piece, found from a nearby one.

    `pieces` as from `moving_average`, indexed as pieces[i][j].
    """
    while index + 1 < len(pieces) and u >= pieces[index + 1][0]:
        index += 1
    while index > 0 and u < pieces[index][0]:
        index -= 1
    row = pieces[index]
    d = u - row[0]
    return row[1] + (row[2] + row[3] * d) * d, row[2] + 2.0 * row[3] * d, 2.0 * row[3], index


def quadratics_at(u: FloatArray, pieces: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values and first derivatives at an array of any shape; vectorised with numpy."""
    index = np.clip(np.searchsorted(pieces[:, 0], u, side="right") - 1, 0, len(pieces) - 1)
    start, c0, c1, c2 = np.moveaxis(pieces[index], -1, 0)
    d = u - start
    return c0 + (c1 + c2 * d) * d, c1 + 2.0 * c2 * d
