"""Heeding the fence, or not."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink


def test_it_is_switched_on_and_off(bench: Any) -> None:
    assert bench.command(207, 1)[0] == bench.command(207, 0)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.asked[::2] == [("enable_fence", True), ("enable_fence", False)]
    bench.vehicle.refusal = "no fence: upload one first"
    assert bench.refused(207, 1) == (mavlink.MAV_RESULT_FAILED, "no fence: upload one first")


@pytest.mark.parametrize("params", [(2,), (0.5,), (1, 4)])
def test_single_fences_are_not(bench: Any, params: tuple[float, ...]) -> None:
    assert bench.command(207, *params)[0] == mavlink.MAV_RESULT_DENIED
