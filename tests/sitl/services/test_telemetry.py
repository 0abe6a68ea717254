"""What is true of the streams' timing."""

import math
from collections import Counter
from dataclasses import replace
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Peer
from sitl.services.stream_messages.view import View
from sitl.services.telemetry import Telemetry

PEER, OTHER = Peer("tcp", "127.0.0.1", 1), Peer("tcp", "127.0.0.1", 2)
ATTITUDE = mavlink.MAVLINK_MSG_ID_ATTITUDE


@pytest.fixture
def view(make_vehicle: Any, make_mission: Any, frame: Any) -> View:
    vehicle = make_vehicle(1)
    return View(vehicle.snapshot(), frame, vehicle.home, make_mission(3), (1, 0, 0), 0.0)


def fly(telemetry: Telemetry, view: View, first_tick: int, last_tick: int) -> Counter[str]:
    """What is sent from one tick to another, by type."""
    sent: Counter[str] = Counter()
    for tick in range(first_tick, last_tick + 1):
        sent.update(
            message.get_type() for _, due in telemetry.due(tick * 0.04, [PEER], lambda: view) for message in due
        )
    return sent


def test_defaults_are_about_one_a_second(view: View) -> None:
    sent = fly(Telemetry(), view, 1, 2500)
    assert sent["ATTITUDE"] == sent["GLOBAL_POSITION_INT"] == sent["MISSION_CURRENT"] == 101
    assert sent["HOME_POSITION"] == 11
    assert "GPS_GLOBAL_ORIGIN" not in sent


def test_streams_of_one_rate_leave_at_one_tick(view: View) -> None:
    telemetry = Telemetry()
    ticks = [tick for tick in range(100) if telemetry.due(tick * 0.04, [PEER], lambda: view)]
    assert ticks == [0, 25, 50, 75]


@pytest.mark.parametrize(("interval_us", "per_minute"), [(40_000, 1500), (100_000, 600), (300_000, 200), (7e6, 8)])
def test_an_interval_holds_in_the_mean_whatever_the_tick(view: View, interval_us: float, per_minute: int) -> None:
    telemetry = Telemetry()
    assert telemetry.set_interval_us(PEER, ATTITUDE, interval_us)
    assert fly(telemetry, view, 1, 1500)["ATTITUDE"] == pytest.approx(per_minute, abs=1)


def test_a_stream_can_be_switched_off_and_back_to_its_default(view: View) -> None:
    telemetry = Telemetry()
    assert telemetry.set_interval_us(PEER, ATTITUDE, -1)
    assert fly(telemetry, view, 0, 100)["ATTITUDE"] == 0
    assert telemetry.set_interval_us(PEER, ATTITUDE, 0)
    assert telemetry.interval_us(PEER, ATTITUDE) == 1_000_000
    assert fly(telemetry, view, 101, 200)["ATTITUDE"] == 4


@pytest.mark.parametrize("interval_us", [1, 39_999, -2, math.nan, math.inf])
def test_intervals_that_cannot_be_had_are_refused(interval_us: float) -> None:
    assert not Telemetry().set_interval_us(PEER, ATTITUDE, interval_us)


def test_some_streams_flow_only_when_there_is_something_to_say(view: View) -> None:
    sent = fly(Telemetry(), view, 0, 100)
    assert (sent["FENCE_STATUS"], sent["NAMED_VALUE_FLOAT"]) == (0, 0)
    busy = replace(view, snapshot=replace(view.snapshot, fence_enabled=True, in_formation=True))
    sent = fly(Telemetry(), busy, 0, 100)
    assert (sent["FENCE_STATUS"], sent["NAMED_VALUE_FLOAT"]) == (5, 10)


@pytest.mark.parametrize(("rate_hz", "interval_us"), [(4, 250_000), (10, 100_000), (1000, 40_000), (65535, 40_000)])
def test_a_group_gets_the_rate_asked_for_as_far_as_it_can_be_had(rate_hz: int, interval_us: int) -> None:
    telemetry = Telemetry()
    telemetry.request_group(PEER, mavlink.MAV_DATA_STREAM_ALL, rate_hz)
    assert telemetry.interval_us(PEER, ATTITUDE) == interval_us
    telemetry.request_group(PEER, mavlink.MAV_DATA_STREAM_EXTRA1, 0)
    assert telemetry.interval_us(PEER, ATTITUDE) == -1


def test_asking_again_and_again_holds_nothing_up(view: View) -> None:
    telemetry = Telemetry()
    sent: Counter[str] = Counter()
    for tick in range(1, 251):
        telemetry.request_group(PEER, mavlink.MAV_DATA_STREAM_ALL, 4)
        sent.update(
            message.get_type() for _, due in telemetry.due(tick * 0.04, [PEER], lambda: view) for message in due
        )
    assert sent["ATTITUDE"] == pytest.approx(40, abs=1)


def test_each_peer_has_the_intervals_it_asked_for(view: View) -> None:
    telemetry = Telemetry()
    assert telemetry.set_interval_us(PEER, ATTITUDE, 200_000)
    sent: dict[Peer, Counter[str]] = {PEER: Counter(), OTHER: Counter()}
    for tick in range(1, 251):
        for peers, messages in telemetry.due(tick * 0.04, [PEER, OTHER], lambda: view):
            for peer in peers:
                sent[peer].update(message.get_type() for message in messages)
    assert (sent[PEER]["ATTITUDE"], sent[OTHER]["ATTITUDE"]) == (50, 11)
    assert sent[PEER]["VFR_HUD"] == sent[OTHER]["VFR_HUD"] == 11
    telemetry.forget(PEER)
    assert telemetry.interval_us(PEER, ATTITUDE) == 1_000_000


def test_unknown_streams_are_refused() -> None:
    assert not Telemetry().set_interval_us(PEER, mavlink.MAVLINK_MSG_ID_RAW_IMU, 1_000_000)
    assert not Telemetry().set_interval_us(PEER, math.nan, 1_000_000)
    assert Telemetry().interval_us(PEER, 99_999) is None


def test_nothing_is_made_when_nothing_is_due(view: View) -> None:
    telemetry = Telemetry()
    telemetry.due(0.0, [PEER], lambda: view)
    assert [tick for tick in range(60) if telemetry.is_due(tick * 0.04)] == list(range(25, 60))

    def unwanted() -> View:
        raise AssertionError("a view was made")

    assert telemetry.due(0.04, [PEER], unwanted) == []
