"""Telemetry logs: each frame behind its time, as Mission Planner and mavlogdump read them."""

import struct
from pathlib import Path

from missions.errors import InputError

_STAMP = struct.Struct(">Q")


class TelemetryLog:
    """One vehicle's `.tlog`, both directions, complete on disk after every frame.

    Args:
        path: file to write.
        start_s: wall time (Unix) that simulated time 0 is stamped with.
    """

    def __init__(self, path: Path, start_s: float) -> None:
        try:
            self._file = path.open("wb", buffering=0)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}; choose a folder that can be written to") from error
        self._path = path
        self._start_us = round(start_s * 1e6)
        self._failure: OSError | None = None

    def write(self, simulated_ms: int, frame: bytes) -> None:
        """Add one frame, stamped with the start plus the simulated time; nothing once closed, or after a failure."""
        if self._file.closed or self._failure is not None:
            return
        try:
            self._file.write(_STAMP.pack(self._start_us + simulated_ms * 1000) + frame)
        except OSError as error:
            self._failure = error

    def check(self) -> None:
        """Raise InputError when the log is not complete, because a frame could not be written."""
        if self._failure is not None:
            raise InputError(f"{self._path}: {self._failure.strerror}; the log ends early, make room and fly again")

    def close(self) -> None:
        """Close the file."""
        self._file.close()
