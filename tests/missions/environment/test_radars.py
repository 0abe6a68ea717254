"""Exposure is being inside any radar's sphere."""

import numpy as np

from missions.environment import Radar
from missions.environment.radars import exposed

RADARS = (Radar(0, 0, 0, 1000, 1000), Radar(5000, 0, 1000, 500, 500))


def test_points_inside_any_sphere_are_exposed() -> None:
    points = np.array([[0, 0, 999], [0, 0, 1001], [5000, 400, 1200], [5000, 400, 1400.0]])
    assert exposed(points, RADARS).tolist() == [True, False, True, False]


def test_without_radars_nothing_is_exposed() -> None:
    assert not exposed(np.zeros((3, 2, 3)), ()).any()
