"""What came of one link in a flight."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class LinkReport:
    """What its receiver counted of the samples of one link.

    Attributes:
        sender, receiver: sysids.
        refused: messages that were let in by no door, by reason.
        heard: samples that came, in real time.
        late: of these, those that lockstep would have waited for; in lockstep none are.
        lost: samples that never came, told from gaps in the sequence numbers; what a channel's model loses, came.
        delay_mean_s, delay_max_s: simulated seconds from a sample's stamp to its arrival and through the channel's
            model, so that the injected delay comes on top of the real one; None in lockstep, where delays are exact.
    """

    sender: int
    receiver: int
    refused: Mapping[str, int] = field(default_factory=dict)
    heard: int = 0
    late: int = 0
    lost: int = 0
    delay_mean_s: float | None = None
    delay_max_s: float | None = None


def mean_delay_s(links: Iterable[LinkReport]) -> float | None:
    """Over the samples of all links; None where it was not measured."""
    measured = [(link.heard, link.delay_mean_s) for link in links if link.delay_mean_s is not None]
    heard = sum(count for count, _ in measured)
    return sum(count * delay_s for count, delay_s in measured) / heard if heard else None
