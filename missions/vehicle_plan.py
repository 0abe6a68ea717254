"""All that one vehicle can be given: a mission, a fence and rally points."""

from dataclasses import dataclass

from missions.fence import NO_FENCE, Fence
from missions.mission import Mission, MissionItem


@dataclass(frozen=True)
class Plan:
    """All that one vehicle can be given.

    Attributes:
        mission: home first.
        fence: where it may be.
        rally: rally points, NAV_RALLY_POINT items.
    """

    mission: Mission
    fence: Fence = NO_FENCE
    rally: tuple[MissionItem, ...] = ()
