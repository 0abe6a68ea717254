from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from gcs.metrics.schedule import along_path_m, schedule
from gcs.metrics.tracks import tracks
from missions.reference import Reference
from missions.reference.path import fillet
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

Fly = Callable[[dict[int, Reference]], dict[int, np.ndarray]]
LATE_TICKS = 75
"""Three seconds."""


def test_a_late_vehicle_is_behind_by_what_it_would_have_flown(
    radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan], fly_exactly: Fly
) -> None:
    references = straight_plan(radars).references(radars)
    truths = fly_exactly(references)
    truths[2] = np.vstack([np.repeat(truths[2][:1], LATE_TICKS, axis=0), truths[2]])
    result = schedule(tracks(references, truths), references, {})
    behind_m = -3.0 * references[2].leg_ground_speed_m_s[0]
    moving = (result.t_s > 3.0) & np.isfinite(result.planned_m[1])
    np.testing.assert_allclose(result.deviation_m[1, moving], behind_m, atol=0.01)
    np.testing.assert_allclose(result.deviation_m[0, np.isfinite(result.planned_m[0])], 0.0, atol=0.01)


def test_says_nothing_after_the_arrival(
    radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan], fly_exactly: Fly
) -> None:
    references = straight_plan(radars).references(radars)
    result = schedule(tracks(references, fly_exactly(references)), references, {1: 800.0})
    assert np.isfinite(result.deviation_m[0, result.t_s <= 800.0]).all()
    assert np.isnan(result.deviation_m[0, result.t_s > 800.0]).all()


def test_projects_on_arcs_and_near_the_planned_place_where_a_path_crosses_itself(
    radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan]
) -> None:
    corners = np.array([[0.0, 0.0], [9000.0, 0.0], [9000.0, 9000.0], [4500.0, 9000.0], [4500.0, -9000.0]])
    reference = replace(straight_plan(radars).references(radars)[1], path=fillet(corners, 300.0))
    s_m = np.linspace(50.0, reference.length_m - 50.0, 3001)
    x, y, heading, _ = reference.path.at(s_m)
    beside = np.column_stack([x - 20.0 * np.sin(heading), y + 20.0 * np.cos(heading), np.zeros_like(x)])
    assert along_path_m(beside, s_m + 400.0, reference) == pytest.approx(s_m, abs=0.5)
