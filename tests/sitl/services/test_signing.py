"""What is true of signatures, against pymavlink's, and of what is let in."""

import itertools
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.errors import InputError
from sitl.services.codec import Codec
from sitl.services.signing import EPOCH_S, TICKS_PER_S, Signing, Verdict
from sitl.store import Store

KEY = bytes(range(32))
OTHER_KEY = bytes(range(1, 33))
NOW_S = 1_790_000_000.0


class Clock:
    """A wall clock to be set."""

    def __init__(self, time_s: float = NOW_S) -> None:
        self.time_s = time_s

    def __call__(self) -> float:
        return self.time_s


def timestamp_at(time_s: float) -> int:
    return round((time_s - EPOCH_S) * TICKS_PER_S)


def heartbeat() -> mavlink.MAVLink_message:
    return mavlink.MAVLink_heartbeat_message(1, 3, 81, 10, 3, 3)


def packed(signing: Signing, codec: Codec | None = None) -> bytes:
    return (codec or Codec(3, 1)).pack(heartbeat(), signing)


def timestamp_in(frame: bytes) -> int:
    return int.from_bytes(frame[-12:-6], "little")


def pymavlink_end(key: bytes = KEY, timestamp: int = timestamp_at(NOW_S), link_id: int = 0) -> Any:
    end = mavlink.MAVLink(None, srcSystem=3, srcComponent=1)
    end.signing.secret_key = key
    end.signing.sign_outgoing = True
    end.signing.timestamp = timestamp
    end.signing.link_id = link_id
    return end


@settings(max_examples=50)
@given(st.binary(min_size=32, max_size=32).filter(any), st.integers(0, 255), st.binary(max_size=50))
def test_signed_frames_are_pymavlinks_bit_for_bit(key: bytes, link_id: int, text: bytes) -> None:
    message = mavlink.MAVLink_statustext_message(4, text)
    ours = Codec(3, 1, link_id).pack(message, Signing(key=key, now=Clock()))
    assert ours == message.pack(pymavlink_end(key, timestamp_in(ours), link_id))


def test_pymavlink_reads_what_is_signed_and_refuses_another_key() -> None:
    frame = packed(Signing(key=KEY, now=Clock()))
    assert pymavlink_end().decode(bytearray(frame)).get_signed()
    with pytest.raises(mavlink.MAVError):
        pymavlink_end(OTHER_KEY).decode(bytearray(frame))


def test_what_pymavlink_signs_is_good_once_and_only_with_the_key() -> None:
    end = pymavlink_end()
    frames = [bytes(heartbeat().pack(end)) for _ in range(2)]
    signing = Signing(key=KEY, now=Clock())
    assert Signing(key=OTHER_KEY, now=Clock()).judge(frames[0]) is Verdict.WRONG
    assert [signing.judge(frame) for frame in frames] == [Verdict.GOOD] * 2
    assert [signing.judge(frame) for frame in frames] == [Verdict.OLD] * 2
    assert Codec(255, 190).feed(frames[0])[0].custom_mode == 10


def test_unsigned_frames_of_either_version_are_not_let_in() -> None:
    signing = Signing(key=KEY, now=Clock())
    assert signing.judge(packed(Signing())) is Verdict.UNSIGNED
    old = bytes(heartbeat().pack(mavlink.MAVLink(None, 3, 1), force_mavlink1=True))
    assert signing.judge(old) is Verdict.UNSIGNED


@given(st.integers(0, 8 * 33 - 1))
def test_no_bit_of_a_signed_frame_can_be_changed(bit: int) -> None:
    frame = bytearray(packed(Signing(key=KEY, now=Clock())))
    frame[bit // 8 % len(frame)] ^= 1 << bit % 8
    assert Signing(key=KEY, now=Clock()).judge(bytes(frame)) is not Verdict.GOOD


def test_a_forged_frame_does_not_spoil_the_stream_it_claims_to_be_of() -> None:
    clock, signing = Clock(), Signing(key=KEY, now=Clock())
    sender = Signing(key=KEY, now=clock)
    first = packed(sender)
    clock.time_s += 1000.0
    forged = bytearray(packed(sender))
    forged[-1] ^= 1
    clock.time_s -= 1000.0
    assert signing.judge(bytes(forged)) is Verdict.WRONG
    assert signing.judge(first) is Verdict.GOOD


@pytest.mark.parametrize(("lag_s", "verdict"), [(59.0, Verdict.GOOD), (61.0, Verdict.OLD), (-600.0, Verdict.GOOD)])
def test_a_new_stream_may_be_a_minute_late(lag_s: float, verdict: Verdict) -> None:
    late = packed(Signing(key=KEY, now=Clock(NOW_S - lag_s)))
    assert Signing(key=KEY, now=Clock()).judge(late) is verdict


def test_streams_are_told_apart_by_link_and_sender() -> None:
    signing = Signing(key=KEY, now=Clock())
    for codec in (Codec(3, 1), Codec(4, 1), Codec(3, 2), Codec(3, 1, 1)):
        sender = Signing(key=KEY, now=Clock())
        assert signing.judge(packed(sender, codec)) is Verdict.GOOD


def test_timestamps_rise_by_one_at_least_and_follow_the_other_end() -> None:
    clock = Clock()
    signing = Signing(key=KEY, now=clock)
    times = [timestamp_in(packed(signing)) for _ in range(3)]
    assert times == [times[0], times[0] + 1, times[0] + 2]
    clock.time_s -= 100.0
    assert timestamp_in(packed(signing)) == times[2] + 1
    ahead = packed(Signing(key=KEY, now=Clock(NOW_S + 500.0)))
    assert signing.judge(ahead) is Verdict.GOOD
    assert timestamp_in(packed(signing)) == timestamp_in(ahead)


@given(st.lists(st.sampled_from(["send", "restart", "second", "back"]), max_size=30))
def test_no_timestamp_is_used_twice_over_any_restarts(steps: list[str]) -> None:
    store, clock, times = Store(), Clock(), [0]
    signing = Signing(store, KEY, clock)
    for step in steps:
        if step == "send":
            times.append(timestamp_in(packed(signing)))
        elif step == "restart":
            signing = Signing(store, None, clock)
        else:
            clock.time_s += 7.0 if step == "second" else -20.0
    assert all(later > earlier for earlier, later in itertools.pairwise(times))


def test_a_restart_locks_out_no_station_with_a_slow_clock() -> None:
    store = Store()
    packed(Signing(store, KEY, Clock()))
    late = packed(Signing(key=KEY, now=Clock(NOW_S - 55.0)))
    assert Signing(store, None, Clock()).judge(late) is Verdict.GOOD


def test_the_key_is_kept_and_so_is_having_none(tmp_path: Path) -> None:
    Signing(Store(tmp_path), None).set_key(KEY, 5)
    assert Signing(Store(tmp_path)).key == KEY
    assert Signing(Store(tmp_path), OTHER_KEY).key == OTHER_KEY
    Signing(Store(tmp_path)).set_key(None, 0)
    again = Signing(Store(tmp_path))
    assert again.key is None
    assert again.judge(packed(again)) is Verdict.GOOD


def test_no_key_that_is_none_and_no_start_in_the_far_future() -> None:
    signing = Signing(key=KEY, now=Clock())
    for key, timestamp in ((bytes(32), 1), (b"short", 0), (OTHER_KEY, 2**64 - 1)):
        with pytest.raises(InputError):
            signing.set_key(key, timestamp)
    assert signing.key == KEY


def test_what_cannot_be_kept_is_told_and_stops_nothing(tmp_path: Path) -> None:
    clock, folder = Clock(), tmp_path / "memory"
    signing = Signing(Store(folder), KEY, clock)
    (folder / "signing").unlink()
    folder.rmdir()
    folder.write_text("a file where the folder was")
    clock.time_s += 60.0
    packed(signing)
    assert signing.trouble is not None
