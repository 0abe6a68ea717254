"""An elevation file as a grid of posts that places on the globe can be looked up in."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class ElevationSource:
    """Heights AMSL on a grid, not yet read.

    Attributes:
        shape: posts along rows and columns, (rows, columns).
        cells_of: (longitude, latitude) in degrees, arrays of one shape, to (column, row); post [r, c] is at (c, r).
            Infinite where a place has no position in the file's own coordinates.
        read: (first row, last row, first column, last column), the last ones included, to heights in metres, float64,
            nan where the file has none.
    """

    shape: tuple[int, int]
    cells_of: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]
    read: Callable[[int, int, int, int], FloatArray]
