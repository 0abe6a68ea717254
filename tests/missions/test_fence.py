"""What is true of a fence and its items."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, parse_fence
from missions.mission import MissionItem

PLACES = st.tuples(st.integers(-900_000_000, 900_000_000), st.integers(-1_800_000_000, 1_800_000_000))
POLYGONS = st.builds(FencePolygon, st.booleans(), st.lists(PLACES, min_size=3, max_size=6).map(tuple))
CIRCLES = st.builds(FenceCircle, st.booleans(), PLACES, st.floats(1.0, 1e5, width=32))
FENCES = st.builds(Fence, st.lists(POLYGONS | CIRCLES, max_size=5).map(tuple), st.none() | PLACES)


@given(FENCES)
def test_a_fence_survives_its_items(fence: Fence) -> None:
    assert parse_fence(fence_items(fence)) == fence


def vertex(count: float, command: Command = Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION) -> MissionItem:
    return MissionItem(command, Frame.GLOBAL, count, lat_e7=1, lon_e7=2)


@pytest.mark.parametrize(
    ("items", "reason"),
    [
        ([vertex(2), vertex(2)], "fence item 0: a polygon needs at least 3 vertices, got 2"),
        ([vertex(float("nan"))], "fence item 0: a polygon needs at least 3 vertices, got nan"),
        ([vertex(4)] * 3, "fence item 0: 3 of 4 vertices"),
        ([vertex(3), vertex(3), vertex(4)], "fence item 2: should be a vertex of the polygon of 3 at item 0"),
        ([vertex(0, Command.NAV_FENCE_CIRCLE_EXCLUSION)], "fence item 0: radius must be positive, got 0 m"),
        ([MissionItem(Command.NAV_WAYPOINT)], "fence item 0: command 16 is none of a fence"),
    ],
)
def test_what_is_no_fence_is_refused_with_its_item(items: list[MissionItem], reason: str) -> None:
    with pytest.raises(InputError) as error:
        parse_fence(items)
    assert str(error.value) == reason
