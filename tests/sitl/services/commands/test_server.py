"""What is true of every command."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

SUPPORTED = {17, 20, 22, 176, 178, 179, 192, 207, 224, 262, 300, 400, 401, 410, 510, 511, 512, 520}


def test_all_others_are_unsupported(bench: Any) -> None:
    for number in (*mavlink.enums["MAV_CMD"], 0, 65535):
        if number not in SUPPORTED and number < 2**16:
            assert bench.command(number) == (mavlink.MAV_RESULT_UNSUPPORTED, []), number


@pytest.mark.parametrize("number", [176, 178, 179, 207, 224, 262, 300, 400, 510, 511, 512, 520])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_nothing_is_done_for_numbers_that_are_none(bench: Any, number: int, value: float) -> None:
    result, _ = bench.command(number, *[value] * 7)
    assert result in (mavlink.MAV_RESULT_DENIED, mavlink.MAV_RESULT_FAILED)
    assert bench.vehicle.asked == []


def test_data_streams_by_the_old_request(bench: Any) -> None:
    def interval_us(message_id: int) -> int:
        return int(bench.command(510, message_id)[1][0].interval_us)

    assert bench.tell(mavlink.MAVLink_request_data_stream_message(3, 1, mavlink.MAV_DATA_STREAM_EXTRA1, 10, 1)) == []
    assert (interval_us(30), interval_us(33)) == (100_000, 1_000_000)
    bench.tell(mavlink.MAVLink_request_data_stream_message(3, 1, mavlink.MAV_DATA_STREAM_ALL, 4, 1))
    assert [interval_us(n) for n in (30, 33, 1, 242)] == [250_000, 250_000, 250_000, 10_000_000]
    bench.tell(mavlink.MAVLink_request_data_stream_message(3, 1, mavlink.MAV_DATA_STREAM_POSITION, 4, 0))
    assert [interval_us(n) for n in (30, 33)] == [250_000, -1]
