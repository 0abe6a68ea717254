"""How well a vehicle keeps its place in the formation, as values that any station can plot."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message
from sitl.services.stream_messages.view import View


def formation_values(view: View) -> tuple[Message, ...]:
    """NAMED_VALUE_FLOAT: FormErr, metres along track ahead of its schedule, and FormDelay, seconds; with a swarm clock
    FormShift, seconds by which that is ahead of its time; in real time FormLate and FormLost, counts.

    Delay and counts are those of the neighbours' corrections.
    """
    now = view.snapshot
    values = [(b"FormErr", now.along_track_m), (b"FormDelay", now.formation_delay_s)]
    if now.schedule_shift_s is not None:
        values.append((b"FormShift", now.schedule_shift_s))
    if now.late_samples is not None and now.lost_samples is not None:
        values += [(b"FormLate", float(now.late_samples)), (b"FormLost", float(now.lost_samples))]
    return tuple(mavlink.MAVLink_named_value_float_message(view.time_boot_ms, name, value) for name, value in values)
