"""Distances from a tall building."""

import numpy as np
import pytest

from missions.environment import Obstacle
from missions.environment.obstacles import wall_distances_m

TOWER = Obstacle(0.0, 0.0, 500.0, 2000.0)


@pytest.mark.parametrize(
    ("point", "distance"),
    [((600, 0, 100), 100), ((0, 0, 2300), 300), ((0, 100, 1999), 0), ((800, 0, 2400), 500), ((0, 500, 2000), 0)],
)
def test_distance_is_to_the_nearest_part_of_the_surface(point: tuple[float, float, float], distance: float) -> None:
    assert wall_distances_m(np.array(point, dtype=float), TOWER) == pytest.approx(distance)
