from dataclasses import replace

from gcs.campaign.axes import make_axes
from gcs.campaign.campaign import Campaign
from gcs.campaign.case import Case


def test_every_combination_is_flown_with_every_seed_once(campaign: Campaign) -> None:
    cases = list(campaign.cases())
    assert len(cases) == len(set(cases)) == 2 * 2 * 2
    assert cases[0] == Case((("formation.delay_s", 0.2), ("arm", "full")), 1)
    assert [case.seed for case in cases] == [1] * 4 + [2] * 4, "all combinations come before the next seed"


def test_seeds_and_values_may_be_added_but_nothing_else_may_change(campaign: Campaign) -> None:
    mine = campaign.identity()
    more = make_axes(campaign.scenario, {"formation.delay_s": [0.1], "arm": ["plain"]})
    assert replace(campaign, axes=more, seeds=range(1, 100)).identity() == mine
    windy = campaign.scenario.model_copy(update={"wind": campaign.scenario.wind.model_copy(update={"gusts": "none"})})
    others = {
        "axes": replace(campaign, axes={}),
        "scenario": replace(campaign, scenario=windy),
        "plan": replace(campaign, plan=replace(campaign.plan, uavs=campaign.plan.uavs[:2])),
    }
    for key, other in others.items():
        theirs = other.identity()
        assert [one for one in mine if theirs[one] != mine[one]] == [key]
