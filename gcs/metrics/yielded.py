"""Who gave way to whom, as events of a flight."""

from collections.abc import Iterator

from gcs.flight_record import Event
from sitl.avoidance.yielding import Yieldings
from sitl.ticks import TICK_S


def yielded(yieldings: Yieldings) -> Iterator[Event]:
    """The beginning and the end of each time that a vehicle gave way."""
    for sysid, some in yieldings.items():
        for one in some:
            text = str(one)
            yield Event(one.tick * TICK_S, sysid, text[0].lower() + text[1:])
