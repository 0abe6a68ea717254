"""Piecewise functions of many UAVs in one table: which piece holds at a place, and the largest of a figure over all
pieces that an interval touches."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

TOUCH = 1e-6
"""An interval also touches pieces this far beyond its ends: what rounding may do to either."""


class Pieces:
    """Tables of pieces, one a UAV, each sorted by its first column, where a piece begins.

    The first piece of a table also holds before its start, the last one for ever.
    """

    def __init__(self, tables: list[FloatArray]) -> None:
        counts = np.array([len(table) for table in tables])
        self.last = np.cumsum(counts) - 1
        self.first = self.last + 1 - counts
        self.table = np.concatenate(tables)
        self.row = np.repeat(np.arange(len(tables)), counts)
        self._apart = 2.0 * float(np.abs(self.table[:, 0]).max()) + 1.0
        """Between the tables of two UAVs on the axis on which all are searched at once."""
        self._keys = self.row * self._apart + self.table[:, 0]

    def index(self, row: IntArray, u: FloatArray) -> IntArray:
        """The piece that holds at u in the table of a UAV."""
        found = np.searchsorted(self._keys, row * self._apart + u, side="right") - 1
        return np.clip(found, self.first[row], self.last[row])

    @property
    def lengths(self) -> FloatArray:
        """Of the pieces; 0 for the last ones."""
        lengths = np.diff(self.table[:, 0], append=0.0)
        lengths[self.last] = 0.0
        return lengths


class Largest:
    """The largest of a figure over ranges of pieces, each by two looks into a table of powers of two."""

    def __init__(self, pieces: Pieces, figure: FloatArray) -> None:
        self._pieces = pieces
        levels = [figure]
        while 2 ** len(levels) <= len(figure):
            below, half = levels[-1], 2 ** (len(levels) - 1)
            levels.append(np.append(np.maximum(below[:-half], below[half:]), below[-half:]))
        self._levels = np.array(levels)

    def over(self, row: IntArray, start: FloatArray, end: FloatArray) -> FloatArray:
        """Over the pieces of a UAV that [start, end] touches."""
        first, last = self._pieces.index(row, start - TOUCH), self._pieces.index(row, end + TOUCH)
        level = np.frexp(last - first + 1)[1] - 1
        result: FloatArray = np.maximum(self._levels[level, first], self._levels[level, last + 1 - 2**level])
        return result
