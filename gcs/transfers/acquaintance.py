"""What the station keeps of one vehicle from one transfer to the next."""

from dataclasses import dataclass, field

from gcs.transfers.unanswered import Unanswered
from sitl.services.loss import Loss
from sitl.services.round_trip import RoundTrip

_INITIAL_S = 0.5
"""Time-out before a round trip has been measured: a third of the MAVLink guide's, as what is asked may be repeated."""


@dataclass
class Acquaintance:
    """How a vehicle and the link to it behave.

    Attributes:
        round_trip: how long its answers take.
        loss: how much of what a transfer of a plan asks has to be asked again.
        unanswered: commands whose acknowledgements may still be on their way.
        strict: it serves downloads in strict order only, so that nothing but the next item is to be asked for.
    """

    round_trip: RoundTrip = field(default_factory=lambda: RoundTrip(_INITIAL_S))
    loss: Loss = field(default_factory=Loss)
    unanswered: Unanswered = field(default_factory=Unanswered)
    strict: bool = False
