"""From the safe altitude all straight ways home are clear."""

import numpy as np

from missions.environment import Area, Environment, Obstacle, Terrain, ground_height_m
from missions.environment.terrain import NO_WAVE
from missions.safe_return import safe_return_altitude_m

AREA = Area(0.0, 10_000.0, 0.0, 10_000.0, 0.0, 3_000.0)
HOME = (0.0, 0.0, 0.0)
WAY = np.array([[0.0, 0.0, 30.0], [0.0, 8_000.0, 500.0], [8_000.0, 8_000.0, 900.0]])
HILL = Terrain(0.0, NO_WAVE, [(700.0, 4_000.0, 4_000.0, 1_000.0, 1_000.0)])
FLAT = Terrain(0.0, NO_WAVE, [])


def test_a_hill_between_the_way_and_home_counts_though_the_way_leads_around_it() -> None:
    found = safe_return_altitude_m(HOME, WAY, Environment(AREA, HILL, (), ()), 100.0, 50.0)
    assert abs(found - (ground_height_m(4_000.0, 4_000.0, HILL) + 100.0)) < 0.5


def test_a_hill_away_from_all_lines_does_not_count() -> None:
    away = HILL._replace(peaks=[(700.0, 9_000.0, 1_000.0, 1_000.0, 1_000.0)])
    assert safe_return_altitude_m(HOME, WAY, Environment(AREA, away, (), ()), 100.0, 50.0) < 101.0


def test_a_thin_tower_on_a_line_counts_between_samples_too() -> None:
    for along in np.linspace(0.3, 0.7, 41):
        tower = Obstacle(8_000.0 * along, 8_000.0 * along, 5.0, 400.0)
        assert safe_return_altitude_m(HOME, WAY, Environment(AREA, FLAT, (), (tower,)), 100.0, 10.0) == 500.0


def test_a_tower_beside_all_lines_does_not_count() -> None:
    tower = Obstacle(6_000.0, 1_000.0, 50.0, 400.0)
    assert safe_return_altitude_m(HOME, WAY, Environment(AREA, FLAT, (), (tower,)), 100.0, 50.0) == 100.0
