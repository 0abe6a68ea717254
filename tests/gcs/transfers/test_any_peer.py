"""Whatever a vehicle says, and in whatever order, a transfer comes to an end."""

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.capacity import PlanOffer
from gcs.transfers.command import Command, command_long
from gcs.transfers.parameters import ParameterFetch, ParameterRead, ParameterSet, ParameterValue
from gcs.transfers.plan_clear import PlanClear
from gcs.transfers.plan_download import PlanDownload
from gcs.transfers.plan_upload import PlanUpload
from gcs.transfers.transfer import Transfer
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.codec import Codec
from sitl.services.mission_items import item_message

FENCE = PlanType.FENCE
ITEMS = tuple(MissionItem(5003, param1=100.0 + seq) for seq in range(4))
US = (255, 190)

TRANSFERS = {
    "upload": lambda *link: PlanUpload(FENCE, ITEMS, *link),
    "download": lambda *link: PlanDownload(FENCE, *link),
    "clear": lambda *link: PlanClear(FENCE, *link),
    "offer": lambda *link: PlanOffer(FENCE, *link),
    "parameters": lambda *link: ParameterFetch(*link),
    "read": lambda *link: ParameterRead("A", *link),
    "set": lambda *link: ParameterSet("A", ParameterValue(1.0, 9), *link),
    "command": lambda *link: Command(command_long(400, 1.0), *link),
}

small = st.integers(0, 5)
names = st.sampled_from([b"A", b"B", b""])
MESSAGES = st.one_of(
    st.builds(lambda seq: mavlink.MAVLink_mission_request_int_message(*US, seq, FENCE), small),
    st.builds(lambda seq: mavlink.MAVLink_mission_request_message(*US, seq, FENCE), small),
    st.builds(lambda count: mavlink.MAVLink_mission_count_message(*US, count, FENCE), small),
    st.builds(lambda seq: item_message(ITEMS[seq % 4], seq, *US, FENCE), small),
    st.builds(lambda result: mavlink.MAVLink_mission_ack_message(*US, result, FENCE), st.integers(0, 17)),
    st.builds(lambda result: mavlink.MAVLink_command_ack_message(400, result), st.integers(0, 11)),
    st.builds(
        lambda name, value, count, index: mavlink.MAVLink_param_value_message(name, value, 9, count, index),
        names,
        st.floats(width=32),
        small,
        st.sampled_from([0, 1, 2, 3, 0xFFFF]),
    ),
    st.builds(lambda name, error: mavlink.MAVLink_param_error_message(*US, name, -1, error), names, small),
    st.just(mavlink.MAVLink_statustext_message(4, b"Only 0 items are supported")),
)
PAUSES_S = st.sampled_from([0.0, 0.01, 0.2, 3.0])


class Peer:
    """A vehicle that says the same things over and over, one after the other, and falls silent in the end."""

    def __init__(self, make: Any) -> None:
        self.time_s = 0.0
        self._theirs, self._ours = Codec(3, 1), Codec(*US)
        self.transfer: Transfer[Any] = make(3, 1, lambda message: None, lambda: self.time_s, Acquaintance())
        self.transfer.start()

    def say(self, message: Any) -> None:
        for received in self._ours.feed(self._theirs.pack(message)):
            self.transfer.on_message(received)

    def wait(self, seconds: float) -> None:
        """Let time pass from one deadline to the next."""
        end_s = self.time_s + seconds
        while self.transfer.outcome is None and self.transfer.deadline_s <= end_s:
            self.time_s = max(self.time_s + 1e-3, self.transfer.deadline_s)
            self.transfer.on_tick()
        self.time_s = max(self.time_s, end_s)


@pytest.mark.parametrize("name", TRANSFERS)
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(words=st.lists(st.tuples(PAUSES_S, MESSAGES), max_size=25))
def test_an_end_comes_soon_after_the_last_word(name: str, words: list[tuple[float, Any]]) -> None:
    peer = Peer(TRANSFERS[name])
    for pause_s, message in words:
        peer.wait(pause_s)
        peer.say(message)
    peer.wait(60.0)
    assert peer.transfer.outcome is not None


@pytest.mark.parametrize("name", [name for name in TRANSFERS if name != "command"])
@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(words=st.lists(MESSAGES, min_size=1, max_size=3))
def test_an_end_comes_though_the_vehicle_never_stops_to_talk(name: str, words: list[Any]) -> None:
    peer = Peer(TRANSFERS[name])
    for _ in range(600):
        for message in words:
            peer.say(message)
        peer.wait(0.5)
    assert peer.transfer.outcome is not None
