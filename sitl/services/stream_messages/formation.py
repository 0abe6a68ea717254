"""How well a vehicle keeps its place in the formation, as values that any station can plot."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message
from sitl.services.stream_messages.view import View


def formation_values(view: View) -> tuple[Message, ...]:
    """NAMED_VALUE_FLOAT twice: FormErr, metres along track ahead of its schedule, and FormDelay, seconds.

    The delay is that of the neighbours' corrections.
    """
    now = view.snapshot
    return (
        mavlink.MAVLink_named_value_float_message(view.time_boot_ms, b"FormErr", now.along_track_m),
        mavlink.MAVLink_named_value_float_message(view.time_boot_ms, b"FormDelay", now.formation_delay_s),
    )
