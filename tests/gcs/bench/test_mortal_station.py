"""A station that is to stop after so many messages stops there, whatever has come already."""

import socket
from contextlib import closing
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.bench.mortal_station import MortalStation, socket_for_a_station
from gcs.transfers.plan_upload import PlanUpload
from missions.plan_type import PlanType
from sitl.services.codec import Codec

SYSID = 3


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        (1, ["MISSION_COUNT"]),
        (2, ["MISSION_COUNT"]),
        (3, ["MISSION_COUNT", "MISSION_ITEM_INT"]),
        (4, ["MISSION_COUNT", "MISSION_ITEM_INT"]),
        (5, ["MISSION_COUNT", "MISSION_ITEM_INT", "MISSION_ITEM_INT"]),
    ],
)
def test_it_says_no_more_than_its_steps_allow(make_mission: Any, steps: int, said: list[str]) -> None:
    codec = Codec(SYSID, 1)
    requests = [codec.pack(mavlink.MAVLink_mission_request_int_message(255, 190, seq, 0)) for seq in range(5)]
    with closing(socket_for_a_station()) as endpoint, closing(socket_for_a_station()) as end:
        endpoint.sendto(b"".join(requests), end.getsockname())
        station = MortalStation(endpoint.getsockname()[1], SYSID, end)
        items = make_mission(6).items
        assert station.run(lambda *link: PlanUpload(PlanType.MISSION, items, *link), steps) is None
        heard = []
        while True:
            try:
                heard += codec.feed(endpoint.recv(65536, socket.MSG_DONTWAIT))
            except BlockingIOError:
                break
        assert [message.get_type() for message in heard] == said
