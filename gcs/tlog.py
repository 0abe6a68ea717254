"""Telemetry logs: each frame behind its time, as Mission Planner and mavlogdump read them."""

import struct
import time
from pathlib import Path

from missions.errors import InputError

STAMP = struct.Struct(">Q")
"""Microseconds, Unix time."""


class TelemetryLog:
    """One vehicle's `.tlog`, both directions, complete on disk after every `flush`, and readable at any time.

    Args:
        path: file to write.
        start_s: wall time (Unix) that simulated time 0 is stamped with; None stamps with the time of day.
    """

    def __init__(self, path: Path, start_s: float | None) -> None:
        try:
            self._file = path.open("wb", buffering=0)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}; choose a folder that can be written to") from error
        self._path = path
        self._start_us = None if start_s is None else round(start_s * 1e6)
        self._waiting = bytearray()
        self._failure: OSError | None = None

    def write(self, simulated_ms: int, frame: bytes) -> None:
        """Add one frame with its time; nothing once closed, or after a failure."""
        at_us = time.time_ns() // 1000 if self._start_us is None else self._start_us + simulated_ms * 1000
        self._waiting += STAMP.pack(at_us)
        self._waiting += frame

    def flush(self) -> None:
        """Bring what was written to the disk; nothing once closed, or after a failure."""
        if self._waiting and self._failure is None and not self._file.closed:
            try:
                while self._waiting:
                    del self._waiting[: self._file.write(self._waiting)]
            except OSError as error:
                self._failure = error
        self._waiting.clear()

    def check(self) -> None:
        """Raise InputError when the log is not complete, because a frame could not be written."""
        if self._failure is not None:
            raise InputError(f"{self._path}: {self._failure.strerror}; the log ends early, make room and fly again")

    def close(self) -> None:
        """Close the file, complete."""
        self.flush()
        self._file.close()
