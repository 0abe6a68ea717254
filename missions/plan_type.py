"""What a vehicle can be given: a mission, a fence, rally points (MAV_MISSION_TYPE)."""

from enum import IntEnum


class PlanType(IntEnum):
    """Numbers of MAV_MISSION_TYPE. A vehicle holds one plan of each of the first three."""

    MISSION = 0
    FENCE = 1
    RALLY = 2
    ALL = 255
    """For clearing only."""


HELD = (PlanType.MISSION, PlanType.FENCE, PlanType.RALLY)
"""In the order in which stations transfer them."""
