"""What counts as the same mission."""

import math
from dataclasses import replace
from typing import Any

from gcs.transfers.compare import differences
from missions.mission import Mission


def changed(mission: Mission, seq: int, **changes: Any) -> Mission:
    items = list(mission.items)
    items[seq] = replace(items[seq], **changes)
    return Mission(tuple(items))


def test_what_autopilots_round_away_is_no_difference(make_mission: Any) -> None:
    sent = make_mission(6)
    held = changed(sent, 4, lat_e7=sent[4].lat_e7 + 1, alt_m=sent[4].alt_m + 0.005, param2=sent[4].param2 + 4e-4)
    assert differences(sent, held) == []


def test_each_item_and_field_that_differs_is_named(make_mission: Any) -> None:
    sent = make_mission(6)
    held = changed(changed(sent, 4, alt_m=1400.0, frame=3), 2, param2=19.0)
    assert differences(sent, held) == [
        "item 2: param2 is 19, sent 20.2857151",
        "item 4: frame is 3, sent 0",
        "item 4: alt_m is 1400, sent 1501.33337",
    ]


def test_a_missing_item_is_a_difference(make_mission: Any) -> None:
    assert differences(make_mission(6), make_mission(5)) == ["5 items held, 6 sent"]


def test_the_vehicles_own_home_is_none(make_mission: Any) -> None:
    sent = make_mission(6)
    assert differences(sent, sent.with_home(sent[1])) == []


def test_nan_equals_nan_only(make_mission: Any) -> None:
    sent = changed(make_mission(6), 4, param4=math.nan)
    assert differences(sent, changed(sent, 4, param4=math.nan)) == []
    assert differences(sent, make_mission(6)) == ["item 4: param4 is 0, sent nan"]
