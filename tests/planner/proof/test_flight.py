"""Airspeed and climb rate at every instant of random flights, against samples every hundredth of a second."""

from collections.abc import Callable

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.reference import Reference
from missions.scenario import Scenario
from planner.proof.bracket import RESOLUTION_M
from planner.proof.flight import spare_speeds
from planner.proof.tracks import Tracks


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    wind=st.tuples(st.floats(-8, 8), st.floats(-8, 8)),
    slowest=st.floats(15, 25),
    climb=st.floats(0.5, 4.0),
)
def test_speeds_beyond_the_airframe_are_found_at_any_instant(
    radars: Scenario,
    make_references: Callable[..., list[Reference]],
    seed: int,
    wind: tuple[float, float],
    slowest: float,
    climb: float,
) -> None:
    airframe = radars.airframe.model_copy(
        update={"airspeed_min_m_s": slowest, "climb_rate_max_m_s": climb, "climb_rate_min_m_s": -climb}
    )
    blowing = radars.wind.model_copy(update={"forecast_m_s": wind})
    references = make_references(seed, 2)
    found = spare_speeds(Tracks(references), radars.model_copy(update={"airframe": airframe, "wind": blowing}))
    for row, reference in enumerate(references):
        t = np.arange(0.0, reference.duration_s, 0.01)
        velocities = np.diff(reference.positions(t), axis=0) / 0.01
        airspeeds = np.linalg.norm(velocities - [*wind, 0.0], axis=1)
        for least, truth in (
            (found.slow, airspeeds.min() - slowest),
            (found.fast, airframe.airspeed_max_m_s - airspeeds.max()),
            (found.descent, velocities[:, 2].min() + climb),
            (found.climb, climb - velocities[:, 2].max()),
        ):
            assert min(truth, 0.0) - RESOLUTION_M - 0.05 <= least.low[row] <= truth + 0.001
