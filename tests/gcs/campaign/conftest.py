"""A campaign of three aircraft on a short way: small enough to be flown in a test."""

from pathlib import Path

import pytest

from gcs.campaign.axes import make_axes
from gcs.campaign.campaign import Campaign
from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan
from planner.plan import plan


@pytest.fixture(scope="session")
def short(short_scenario: Path) -> Scenario:
    return load_scenario(str(short_scenario))


@pytest.fixture(scope="session")
def short_plan(short: Scenario) -> FormationPlan:
    return plan(short)


@pytest.fixture(scope="session")
def campaign(short: Scenario, short_plan: FormationPlan) -> Campaign:
    """Two delays, two arms, two seeds."""
    axes = make_axes(short, {"formation.delay_s": [0.2, 0.4], "arm": ["full", "plain"]})
    return Campaign(short, short_plan, axes, range(1, 3))
