"""What the station knows of one vehicle."""

import asyncio
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.vehicle_link import VehicleLink
from sitl.services.codec import Codec
from sitl.services.peer import Peer


@pytest.fixture
def vehicle() -> VehicleLink:
    async def make() -> VehicleLink:
        return VehicleLink(3, 1, Peer("udp", "127.0.0.1", 1), lambda message: b"")

    return asyncio.run(make())


def feed(vehicle: VehicleLink, frames: list[bytes]) -> None:
    for message in Codec(255, 190).feed(b"".join(frames)):
        vehicle.on_message(message)


def frames(count: int) -> list[bytes]:
    codec = Codec(3, 1)
    return [codec.pack(mavlink.MAVLink_system_time_message(0, 40 * number)) for number in range(count)]


def test_gaps_in_the_sequence_are_lost_frames(vehicle: VehicleLink) -> None:
    sent = frames(600)
    del sent[500:503], sent[254:257], sent[7]
    feed(vehicle, sent)
    assert vehicle.lost_frames == 7


def test_the_newest_time_and_messages_are_kept(vehicle: VehicleLink) -> None:
    feed(vehicle, frames(26))
    assert vehicle.simulated_ms == 1000
    assert vehicle.latest["SYSTEM_TIME"].time_boot_ms == 1000


def test_listeners_hear_everything_while_they_listen(vehicle: VehicleLink) -> None:
    heard: list[Any] = []
    sent = frames(5)
    feed(vehicle, sent[:1])
    with vehicle.listening(heard.append):
        feed(vehicle, sent[1:3])
    feed(vehicle, sent[3:])
    assert [message.get_seq() for message in heard] == [1, 2]


def test_status_lines_are_kept(vehicle: VehicleLink) -> None:
    feed(vehicle, [Codec(3, 1).pack(mavlink.MAVLink_statustext_message(4, b"no mission"))])
    assert vehicle.texts == ["no mission"]
