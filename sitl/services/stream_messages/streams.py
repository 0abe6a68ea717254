"""Every message that can be streamed: how it is made, how often, and which of the old protocol's groups it is of."""

from collections.abc import Callable
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.mode_messages import CurrentMode
from sitl.services.peer import Message
from sitl.services.stream_messages.flight import (
    attitude,
    global_position,
    gps_raw,
    local_position,
    nav_controller_output,
    vfr_hud,
    wind,
)
from sitl.services.stream_messages.formation import formation_values
from sitl.services.stream_messages.health import (
    battery_status,
    ekf_status_report,
    extended_sys_state,
    fence_status,
    sys_status,
    system_time,
)
from sitl.services.stream_messages.home import gps_global_origin, home_position
from sitl.services.stream_messages.mission import mission_current
from sitl.services.stream_messages.modes import current_mode
from sitl.services.stream_messages.view import View

OFF_US = -1

_FAST_US = 1_000_000
_SLOW_US = 5_000_000
_SLOWEST_US = 10_000_000

_STATUS = int(mavlink.MAV_DATA_STREAM_EXTENDED_STATUS)
_POSITION = int(mavlink.MAV_DATA_STREAM_POSITION)
_EXTRA1 = int(mavlink.MAV_DATA_STREAM_EXTRA1)
_EXTRA2 = int(mavlink.MAV_DATA_STREAM_EXTRA2)
_EXTRA3 = int(mavlink.MAV_DATA_STREAM_EXTRA3)


@dataclass(frozen=True)
class Stream:
    """One kind of message.

    Attributes:
        build: makes it, or several of it, from a view.
        interval_us: between two by default, microseconds; `OFF_US` for none.
        group: MAV_DATA_STREAM, as ArduPlane groups it for REQUEST_DATA_STREAM; 0 for none.
        when: whether it is worth streaming now; on request it always is.
    """

    build: Callable[[View], Message | tuple[Message, ...]]
    interval_us: int = _FAST_US
    group: int = 0
    when: Callable[[View], bool] | None = None

    def worthwhile(self, view: View) -> bool:
        """Whether to send it without being asked."""
        return self.when is None or self.when(view)

    def messages(self, view: View) -> tuple[Message, ...]:
        """What there is to send."""
        built = self.build(view)
        return built if isinstance(built, tuple) else (built,)


def _fence_enabled(view: View) -> bool:
    return view.snapshot.fence_enabled


def _in_formation(view: View) -> bool:
    return view.snapshot.in_formation


STREAMS: dict[int, Stream] = {
    mavlink.MAVLINK_MSG_ID_ATTITUDE: Stream(attitude, group=_EXTRA1),
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: Stream(global_position, group=_POSITION),
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: Stream(local_position, group=_POSITION),
    mavlink.MAVLINK_MSG_ID_VFR_HUD: Stream(vfr_hud, group=_EXTRA2),
    mavlink.MAVLINK_MSG_ID_GPS_RAW_INT: Stream(gps_raw, group=_STATUS),
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: Stream(sys_status, group=_STATUS),
    mavlink.MAVLINK_MSG_ID_WIND: Stream(wind, group=_EXTRA3),
    mavlink.MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT: Stream(nav_controller_output, group=_STATUS),
    mavlink.MAVLINK_MSG_ID_MISSION_CURRENT: Stream(mission_current, group=_STATUS),
    mavlink.MAVLINK_MSG_ID_SYSTEM_TIME: Stream(system_time, group=_EXTRA3),
    mavlink.MAVLINK_MSG_ID_NAMED_VALUE_FLOAT: Stream(formation_values, group=_EXTRA3, when=_in_formation),
    mavlink.MAVLINK_MSG_ID_FENCE_STATUS: Stream(fence_status, group=_STATUS, when=_fence_enabled),
    mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT: Stream(ekf_status_report, _SLOW_US, _EXTRA3),
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: Stream(extended_sys_state, _SLOW_US),
    CurrentMode.id: Stream(current_mode, _SLOW_US),
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: Stream(home_position, _SLOWEST_US),
    mavlink.MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN: Stream(gps_global_origin, OFF_US),
    mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: Stream(battery_status, OFF_US),
}
"""By message id."""


def picture(view: View) -> list[Message]:
    """One of everything that is streamed by default."""
    shown = [stream for stream in STREAMS.values() if stream.interval_us != OFF_US and stream.worthwhile(view)]
    return [message for stream in shown for message in stream.messages(view)]
