"""What is true of a fence about a planned flight."""

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gcs.check.fence import room_m
from missions.fence import Fence, FenceCircle, FencePolygon
from missions.frame import LocalFrame
from missions.reference.reference import Speed, Way, reference_of
from missions.scenario import load_scenario
from planner.proof.tracks import Tracks
from sitl.fence_watch import FenceAreas

FRAME = LocalFrame(47.4, 8.5, 450.0)
AIRFRAME = load_scenario("vee").airframe.airframe()
PLACE = st.tuples(st.floats(-3000, 3000), st.floats(-3000, 3000))
POLYGONS = st.builds(
    lambda inclusion, corners: FencePolygon(inclusion, tuple(FRAME.to_e7(*corner) for corner in corners)),
    st.booleans(),
    st.lists(PLACE, min_size=3, max_size=7, unique=True),
)
CIRCLES = st.builds(
    lambda inclusion, centre, radius: FenceCircle(inclusion, FRAME.to_e7(*centre), radius),
    st.booleans(),
    PLACE,
    st.floats(50, 4000),
)


@settings(max_examples=40)
@given(POLYGONS | CIRCLES, PLACE)
def test_a_path_has_room_exactly_where_an_endpoint_sees_no_breach(
    area: FencePolygon | FenceCircle, target: tuple[float, float]
) -> None:
    assume(np.hypot(*target) > 50.0)
    way = Way(((0.0, 0.0, 100.0), (*target, 100.0)), (0, 1), (Speed(28.0, over_ground=False),), 0.0, 100.0)
    reference = reference_of(way, AIRFRAME, (0.0, 0.0))
    fence = Fence((area,))
    least = room_m(Tracks([reference]), fence, 0, FRAME)
    areas = FenceAreas(fence, FRAME)
    points = reference.points(np.linspace(0.0, reference.length_m, 150))
    breached = [areas.crossed(x, y) is not None for x, y, _ in points]
    if any(breached):
        assert least.value[0] <= 0.0
    if least.value[0] < -0.1:
        x, y, _ = reference.points(least.at[0])
        assert areas.crossed(x, y) is not None
    if not any(breached):
        assert least.low[0] > -30.0  # between samples it may just touch
