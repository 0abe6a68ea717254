from dataclasses import replace
from pathlib import Path

import pytest

from gcs.campaign.campaign import Campaign
from gcs.campaign.folder import campaign_folder, claim
from missions.errors import InputError
from missions.scenario import read_scenario_text


@pytest.fixture
def text(short_scenario: Path) -> str:
    return read_scenario_text(str(short_scenario))[0]


def test_a_campaign_comes_back_to_its_folder_and_another_is_refused(
    campaign: Campaign, text: str, tmp_path: Path
) -> None:
    out = tmp_path / "runs"
    table = claim(campaign_folder(out, "short"), campaign, text)
    assert claim(campaign_folder(out, "short"), replace(campaign, seeds=range(1, 9)), text) == table
    scenario, plan = campaign_folder(out, "short").read()
    assert (scenario.name, plan.missions) == ("short", campaign.plan.missions)
    other = replace(campaign, plan=replace(campaign.plan, uavs=campaign.plan.uavs[:2]))
    with pytest.raises(InputError, match=r"runs: its rows are of another campaign: plan is .* name a new folder"):
        claim(campaign_folder(out, "short"), other, text)
    with pytest.raises(InputError, match=r"axes is none here and formation.delay_s, arm there"):
        claim(campaign_folder(out, "short"), replace(campaign, axes={}), text)


def test_a_folder_with_something_else_in_it_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "precious.txt").write_text("keep me")
    with pytest.raises(InputError, match="is not empty"):
        campaign_folder(tmp_path, "short")


def test_a_folder_whose_identity_is_damaged(campaign: Campaign, text: str, tmp_path: Path) -> None:
    (tmp_path / "campaign.json").write_text("[]")
    with pytest.raises(InputError, match=r"campaign.json: cannot be read"):
        claim(campaign_folder(tmp_path, "short"), campaign, text)
