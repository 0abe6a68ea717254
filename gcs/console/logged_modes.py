"""In which modes a vehicle flew, by its log."""

from bisect import bisect_right
from pathlib import Path

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.flight_modes import mode_name
from gcs.tlog_reader import read_tlog
from missions.autopilot import Autopilot
from missions.errors import InputError

Modes = list[tuple[float, str]]
"""(simulated time, mode from then on), in order."""


def read_modes(log: Path, sysid: int) -> Modes:
    """The modes of a vehicle, from its HEARTBEATs; none without a log that can be read.

    A log's times are simulated ones, from that of its first message on.
    """
    modes: Modes = []
    start_s: float | None = None
    try:
        for time_s, message in read_tlog(log, frozenset({mavlink.MAVLINK_MSG_ID_HEARTBEAT})):
            start_s = time_s if start_s is None else start_s
            if message.get_srcSystem() != sysid or message.autopilot == mavlink.MAV_AUTOPILOT_INVALID:
                continue
            mode = mode_name(message.custom_mode, Autopilot.ardupilot)
            if not modes or modes[-1][1] != mode:
                modes.append((time_s - start_s, mode))
    except InputError:
        return []
    return modes


def mode_at(modes: Modes, t_s: float) -> str | None:
    """The mode at a time; None when it is not known."""
    i = bisect_right(modes, t_s, key=lambda one: one[0])
    return modes[i - 1][1] if i else None
