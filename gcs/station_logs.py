"""Logs of an operator's commands: one a vehicle and command, in a folder of the operator's choice."""

import os
import time
from collections.abc import Callable
from pathlib import Path

from gcs.tlog import TelemetryLog
from missions.errors import InputError

FOLDER = "SKEIN_LOGS"
"""Names the folder, in the environment; without it commands keep no logs."""


def station_logs() -> Callable[[int], TelemetryLog] | None:
    """What opens `<sysid>-<date and time, UTC>.tlog` for a vehicle; None when no logs are wanted.

    Raises:
        InputError: the folder cannot be made.
    """
    if not (named := os.environ.get(FOLDER)):
        return None
    folder = Path(named)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{FOLDER}: {folder}: {error.strerror}; name a folder that can be written to") from None

    def open_log(sysid: int) -> TelemetryLog:
        now_s = time.time()
        day = time.strftime("%Y%m%dT%H%M%S", time.gmtime(now_s))
        return TelemetryLog(folder / f"{sysid}-{day}.{round(now_s % 1 * 1000):03d}Z.tlog", None)

    return open_log
