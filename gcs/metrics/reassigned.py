"""Who took whose place, as events of a flight and as what it is measured against."""

from collections.abc import Iterator

from gcs.flight_record import Event
from gcs.metrics.planned import Planned
from gcs.metrics.tracks import planned_tracks
from missions.reassignment import Reassigned


def moved(reassigned: Reassigned) -> Iterator[Event]:
    """The beginning and the end of each move, and the places that stay empty."""
    for move in reassigned.moves:
        yield Event(move.start_s, move.sysid, f"takes the place of vehicle {move.place}")
        yield Event(move.end_s, move.sysid, f"is in the place of vehicle {move.place}")
    for gap in reassigned.gaps:
        yield Event(gap.t_s, None, f"the place of vehicle {gap.place} stays empty: {gap.why}")


def with_moves(planned: Planned, reassigned: Reassigned) -> Planned:
    """What was planned, with each vehicle in the place that it took."""
    if not reassigned.moves:
        return planned
    references = reassigned.references(planned.references)
    return Planned(references, planned_tracks(references))
