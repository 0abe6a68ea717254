"""Asking for messages: once, or at an interval."""

import math
from typing import Any

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode
from sitl.services.stream_messages.streams import STREAMS

ACCEPTED, DENIED, FAILED = mavlink.MAV_RESULT_ACCEPTED, mavlink.MAV_RESULT_DENIED, mavlink.MAV_RESULT_FAILED


def test_whatever_is_streamed_is_sent_on_request(bench: Any) -> None:
    for message_id in STREAMS:
        result, messages = bench.command(512, message_id)
        assert (result, {message.get_msgId() for message in messages}) == (ACCEPTED, {message_id})
    for message_id in (65_000, 27, 2.5, -1, math.nan, math.inf):
        assert bench.command(512, message_id) == (FAILED, [])


def test_the_version_tells_what_it_can_do(bench: Any) -> None:
    for number, params in ((512, (148,)), (520, (1,))):
        result, (version,) = bench.command(number, *params)
        assert (result, version.uid) == (ACCEPTED, 3)
        for name in ("MISSION_INT", "COMMAND_INT", "MISSION_FENCE", "MISSION_RALLY", "PARAM_FLOAT", "MAVLINK2"):
            assert version.capabilities & getattr(mavlink, f"MAV_PROTOCOL_CAPABILITY_{name}")
        for name in ("FTP", "TERRAIN", "PARAM_ENCODE_BYTEWISE", "SET_ATTITUDE_TARGET"):
            assert not version.capabilities & getattr(mavlink, f"MAV_PROTOCOL_CAPABILITY_{name}")
    assert bench.command(520, 0)[0] == DENIED


def test_home_by_its_old_command(bench: Any) -> None:
    result, (home,) = bench.command(410)
    assert (result, home.get_type(), home.latitude) == (ACCEPTED, "HOME_POSITION", bench.vehicle.home.lat_e7)


def test_the_modes_there_are_one_by_one_or_all(bench: Any) -> None:
    result, modes = bench.command(512, 435, 0)
    assert result == ACCEPTED
    assert [(mode.mode_index, mode.custom_mode, mode.mode_name) for mode in modes] == [
        (index, int(mode), mode.name) for index, mode in enumerate(Mode, start=1)
    ]
    assert {mode.number_modes for mode in modes} == {len(Mode)}
    result, (third,) = bench.command(512, 435, 3)
    assert (third.mode_name, third.standard_mode) == ("RTL", mavlink.MAV_STANDARD_MODE_SAFE_RECOVERY)
    for index in (len(Mode) + 1, -1, 0.5, math.nan):
        assert bench.command(512, 435, index)[0] == FAILED


def test_intervals_are_set_and_told(bench: Any) -> None:
    assert bench.command(511, 30, 100_000)[0] == ACCEPTED
    result, (interval,) = bench.command(510, 30)
    assert (result, interval.message_id, interval.interval_us) == (ACCEPTED, 30, 100_000)
    for message_id, interval_us in ((30, 1.0), (30, -5.0), (30, math.nan), (65_000, 1e6)):
        assert bench.command(511, message_id, interval_us)[0] == DENIED
    assert bench.command(510, 65_000)[0] == FAILED
