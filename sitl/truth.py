"""The truth file: little-endian float64 rows (x, y, h, V, gamma, chi), one a tick from tick 0 (MODEL, section 7)."""

import struct
from pathlib import Path

from sitl.aircraft.point_mass import AirState

_ROW = struct.Struct("<6d")


class TruthWriter:
    """Writes truth/<sysid>.f64.

    Args:
        path: of the file; None keeps no truth.
    """

    def __init__(self, path: Path | None) -> None:
        self._file = path.open("wb") if path else None

    def write(self, state: AirState) -> None:
        """Add the row of one tick."""
        if self._file:
            self._file.write(_ROW.pack(*state))

    def close(self) -> None:
        """Bring all rows to the disk. Raises OSError when they do not fit."""
        if self._file:
            self._file.close()
