from collections.abc import Callable

import numpy as np

from gcs.metrics.tracks import tracks
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.ticks import TICK_S

Fly = Callable[[dict[int, Reference]], dict[int, np.ndarray]]


def test_vehicles_of_all_lengths_come_to_common_ticks(
    radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan], fly_exactly: Fly
) -> None:
    references = straight_plan(radars).references(radars)
    truths = fly_exactly(references)
    truths[4] = truths[4][:7000]
    del truths[6]
    common = tracks(references, truths)
    assert common.sysids == tuple(range(1, 10))
    last_s = max(reference.duration_s for reference in references.values())
    assert last_s - TICK_S < common.t_s[-1] <= last_s
    assert np.isfinite(common.flown_m[3]).all(axis=1).sum() == 7000
    assert np.isnan(common.flown_m[5]).all()
    np.testing.assert_allclose(common.flown_m[0], truths[1][: len(common.t_s), :3])
    np.testing.assert_allclose(common.planned_m[3, :7000], common.flown_m[3, :7000])
