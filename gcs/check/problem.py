"""What is wrong with a mission file."""

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Problem:
    """One thing that a limit forbids.

    Attributes:
        file: its path.
        item: number of the mission item on the way to which it happens; None for the file as a whole.
        what: in a few words.
        value, limit: what is flown and what is allowed, with their units; empty where words say it all.
        lat_deg, lon_deg: where; None when it is nowhere in particular.
    """

    file: str
    item: int | None
    what: str
    value: str = ""
    limit: str = ""
    lat_deg: float | None = None
    lon_deg: float | None = None

    def as_json(self) -> dict[str, Any]:
        """As JSON values."""
        return asdict(self)
