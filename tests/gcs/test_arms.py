"""What the corrections are worth: the shipped V with all of the law, without neighbours, and as plain autopilots."""

import re
from pathlib import Path
from typing import get_args

import pytest

from gcs.metrics.formation_error import formation_error
from gcs.metrics.tracks import tracks
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from missions.scenario import load_scenario
from planner.plan import plan
from sitl.config import Arm
from sitl.formation.graph import edges


@pytest.fixture(scope="module")
def rms_m() -> dict[Arm, float | None]:
    """Formation error of each arm."""
    vee = load_scenario("vee")
    planned = plan(vee)
    references = planned.references(vee)

    def fly(arm: Arm) -> float | None:
        truths, _ = rehearse_plan(vee, planned, RehearsalOptions(seed=1, delay_s=0.2, arm=arm))
        return formation_error(tracks(references, truths), edges("ring", list(references))).overall_rms_m

    return {arm: fly(arm) for arm in get_args(Arm)}


def test_the_law_keeps_the_formation_within_a_quarter_of_plain_autopilots(rms_m: dict[Arm, float]) -> None:
    assert rms_m["full"] <= 0.25 * rms_m["plain"]


def test_neighbours_are_worth_a_good_third_of_what_is_left(rms_m: dict[Arm, float]) -> None:
    assert rms_m["full"] <= 0.6 * rms_m["own_schedule"]


def test_the_page_of_results_quotes_these_figures(rms_m: dict[Arm, float]) -> None:
    text = (Path(__file__).parents[2] / "docs/results.md").read_text()
    quoted = [float(value) for value in re.findall(r"^\| .*(?:--no-\w+`\)|with neighbours) \| ([\d.]+) m", text, re.M)]
    assert quoted == pytest.approx([rms_m["plain"], rms_m["own_schedule"], rms_m["full"]], rel=0.02)
