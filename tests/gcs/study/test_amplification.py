"""What travels along a graph, against closed forms."""

import numpy as np
import pytest

from gcs.study.amplification import edge_gains
from gcs.study.linear_sweep import amplifications
from missions.scenario import load_scenario
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation


def test_a_vehicle_that_nobody_hears_errs_by_itself() -> None:
    """|1 / (s^2 + d s + p)| is largest at w^2 = p - d^2 / 2, where it is 1 / (d sqrt(p - d^2 / 4))."""
    formation = LinearFormation(np.zeros((2, 2)), Gains(0.0, 0.0, 0.2, 1.0), np.ones(2))
    errors, speeds = edge_gains(formation, 0.3, [(0, 1)])
    assert errors[0] == pytest.approx(1.0 / (0.2 * np.sqrt(0.99)), rel=1e-3)
    assert speeds[0] == pytest.approx(1.0 / 0.2, rel=1e-3), "s / (s^2 + d s + p) is 1 / d at w^2 = p"


def test_along_a_line_errors_become_smaller_from_edge_to_edge() -> None:
    for one in amplifications(load_scenario("vee")):
        assert np.all(np.diff(one.errors_s2) < 0.0), one
        assert np.all(np.diff(one.speeds_s) < 0.0), one
