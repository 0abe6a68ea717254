"""How far it is with its mission."""

from typing import Any

import pytest

from missions.mission import Mission
from sitl.modes import Mode
from sitl.services.stream_messages.mission import mission_current


@pytest.mark.parametrize(
    ("changes", "state", "mode"),
    [
        ({}, 3, 1),
        ({"mode": Mode.LOITER}, 4, 2),
        ({"airborne": False}, 2, 1),
        ({"mission_complete": True}, 5, 1),
    ],
)
def test_the_missions_state(view: Any, changes: dict[str, Any], state: int, mode: int) -> None:
    message = mission_current(view(**changes))
    assert (message.seq, message.total, message.opaque_ids) == (1, 4, (77, 0, 0))
    assert (message.mission_state, message.mission_mode) == (state, mode)


def test_no_mission_has_no_total(view: Any) -> None:
    seen = view()
    object.__setattr__(seen, "mission", Mission((seen.home,)))
    message = mission_current(seen)
    assert (message.total, message.mission_state) == (0xFFFF, 1)
