"""A campaign of three aircraft on a short way: small enough to be flown in a test."""

import pytest

from gcs.campaign.axes import make_axes
from gcs.campaign.campaign import Campaign
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


@pytest.fixture(scope="session")
def campaign(short: Scenario, short_plan: FormationPlan) -> Campaign:
    """Two delays, two arms, two seeds."""
    axes = make_axes(short, {"formation.delay_s": [0.2, 0.4], "arm": ["full", "plain"]})
    return Campaign(short, short_plan, axes, range(1, 3))
