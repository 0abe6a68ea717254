"""A vehicle's fence from its scenario: stay in the area, stay out of radars and obstacles.

An autopilot's exclusion circle has no top: who flies over a building or through a radar's edge is inside, and its
failsafe would end the flight. So what a vehicle's own way comes too near to is no part of its fence.
"""

import numpy as np
import numpy.typing as npt

from missions.environment import Environment, Obstacle, Radar
from missions.fence import Fence, FenceCircle, FencePolygon
from missions.frame import LocalFrame

AREA_MARGIN_M = 200.0
"""From a vehicle's way to the edge of its area, which is widened where there is less: many start on the edge."""
CIRCLE_MARGIN_M = 50.0
"""From a vehicle's way to a circle that it is fenced out of: what gusts and an autopilot's own turns take."""


def surroundings_fence(
    environment: Environment, frame: LocalFrame, way_m: npt.NDArray[np.float64]
) -> tuple[Fence, tuple[str, ...]]:
    """The fence of a vehicle, and what had to be left out of it.

    Args:
        environment: area, radars and obstacles.
        frame: the scenario's local frame.
        way_m: (n, 3) points of all that the vehicle is to fly, close together.

    Returns:
        an inclusion polygon and exclusion circles; names such as "radars[1]" of those that its way comes too near to.
    """
    area = environment.area
    low = np.minimum([area.x_min_m, area.y_min_m], way_m[:, :2].min(axis=0) - AREA_MARGIN_M)
    high = np.maximum([area.x_max_m, area.y_max_m], way_m[:, :2].max(axis=0) + AREA_MARGIN_M)
    corners = ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))
    circles, left_out = [], []
    places: list[tuple[str, Radar | Obstacle]] = [
        *((f"radars[{i}]", radar) for i, radar in enumerate(environment.radars)),
        *((f"obstacles[{i}]", obstacle) for i, obstacle in enumerate(environment.obstacles)),
    ]
    for name, place in places:
        nearest_m = float(np.hypot(way_m[:, 0] - place.x_m, way_m[:, 1] - place.y_m).min())
        if nearest_m < place.radius_m + CIRCLE_MARGIN_M:
            left_out.append(name)
        else:
            circles.append(FenceCircle(False, frame.to_e7(place.x_m, place.y_m), place.radius_m))
    polygon = FencePolygon(True, tuple(frame.to_e7(float(x), float(y)) for x, y in corners))
    return Fence((polygon, *circles)), tuple(left_out)
