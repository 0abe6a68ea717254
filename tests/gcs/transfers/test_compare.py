"""What counts as the same mission."""

import math
from dataclasses import replace
from typing import Any

from gcs.transfers.compare import differences
from missions.autopilot import Autopilot
from missions.commands import Command
from missions.fence import Fence, FenceCircle, fence_items
from missions.mission import Mission
from missions.plan_type import PlanType


def changed(mission: Mission, seq: int, **changes: Any) -> Mission:
    items = list(mission.items)
    items[seq] = replace(items[seq], **changes)
    return Mission(tuple(items))


def test_what_autopilots_round_away_is_no_difference(make_mission: Any) -> None:
    sent = make_mission(6)
    held = changed(sent, 4, lat_e7=sent[4].lat_e7 + 1, alt_m=sent[4].alt_m + 0.005, param2=sent[4].param2 + 4e-4)
    assert differences(PlanType.MISSION, sent.items, held.items) == []


def test_each_item_and_field_that_differs_is_named(make_mission: Any) -> None:
    sent = make_mission(6)
    held = changed(changed(sent, 4, alt_m=1400.0, frame=3), 2, param2=19.0)
    assert differences(PlanType.MISSION, sent.items, held.items) == [
        "item 2: param2 is 19, sent 20.2857151",
        "item 4: frame is 3, sent 0",
        "item 4: alt_m is 1400, sent 1501.33337",
    ]


def test_a_missing_item_is_a_difference(make_mission: Any) -> None:
    assert differences(PlanType.MISSION, make_mission(6).items, make_mission(5).items) == ["5 items held, 6 sent"]


def test_the_vehicles_own_home_is_none(make_mission: Any) -> None:
    sent = make_mission(6)
    assert differences(PlanType.MISSION, sent.items, sent.with_home(sent[1]).items) == []


def test_a_px4_has_no_home_there_and_drops_what_it_has_no_use_for(make_mission: Any) -> None:
    sent = make_mission(6).items[1:]
    pitched = (replace(sent[0], command=Command.NAV_TAKEOFF, param1=10.0, param2=0.0), *sent[1:])
    held = (replace(pitched[0], param1=0.0), *sent[1:])
    assert differences(PlanType.MISSION, pitched, held, Autopilot.px4) == []
    lower = (replace(held[0], alt_m=held[0].alt_m - 1.0), *sent[1:])
    (line,) = differences(PlanType.MISSION, pitched, lower, Autopilot.px4)
    assert line.startswith("item 0: alt_m is ")
    assert differences(PlanType.MISSION, pitched, (), Autopilot.px4) == ["0 items held, 5 sent"]


def test_nan_equals_nan_only(make_mission: Any) -> None:
    sent = changed(make_mission(6), 4, param4=math.nan)
    assert differences(PlanType.MISSION, sent.items, changed(sent, 4, param4=math.nan).items) == []
    assert differences(PlanType.MISSION, sent.items, make_mission(6).items) == ["item 4: param4 is 0, sent nan"]


def test_a_fences_first_item_is_no_home() -> None:
    sent = fence_items(Fence((FenceCircle(True, (1, 2), 300.0),)))
    held = fence_items(Fence((FenceCircle(True, (1, 2), 200.0),)))
    assert differences(PlanType.FENCE, sent, held) == ["item 0: param1 is 200, sent 300"]
