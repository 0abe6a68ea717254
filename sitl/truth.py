"""The truth file: little-endian float64 rows (x, y, h, V, gamma, chi), one a tick from tick 0 (MODEL, section 7); and
beside it, of a vehicle that goes by a swarm's clock, rows of what its schedule has been slowed and hurried, seconds."""

import struct
from pathlib import Path

from sitl.aircraft.point_mass import AirState
from sitl.formation.swarm_clock import Shifts

_ROW = struct.Struct("<6d")
_SHIFTS = struct.Struct("<2d")


def shifts_file(truth: Path) -> Path:
    """The file beside the truth's."""
    return truth.with_suffix(".shifts.f64")


class TruthWriter:
    """Writes truth/<sysid>.f64.

    Args:
        path: of the file; None keeps no truth.
        shifts: whether <sysid>.shifts.f64 is written too.
    """

    def __init__(self, path: Path | None, *, shifts: bool = False) -> None:
        self._file = path.open("wb") if path else None
        self._shifts = shifts_file(path).open("wb") if path and shifts else None

    def write(self, state: AirState, shifts: Shifts) -> None:
        """Add the row of one tick."""
        if self._file:
            self._file.write(_ROW.pack(*state))
        if self._shifts:
            self._shifts.write(_SHIFTS.pack(shifts.slowed.sum_s, shifts.hurried.sum_s))

    def close(self) -> None:
        """Bring all rows to the disk. Raises OSError when they do not fit."""
        for file in (self._file, self._shifts):
            if file:
                file.close()
