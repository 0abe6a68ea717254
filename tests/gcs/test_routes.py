"""One vehicle on several links, and several vehicles with one system id, told apart."""

import time
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.fleet import Fleet
from gcs.links.link import OnBytes, OnPeer, ignore_bytes, ignore_peer
from missions.errors import InputError
from sitl.services.codec import Codec
from sitl.services.peer import Peer

RADIO, CABLE = Peer("serial", "/dev/ttyUSB0", 57600), Peer("tcp", "127.0.0.1", 5760)


class FakeLink:
    """A link without a socket."""

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    def __init__(self) -> None:
        self.on_bytes = ignore_bytes
        self.on_lost = self.on_back = ignore_peer
        self.greeted: tuple[Peer, ...] = ()
        self.sent: list[Peer] = []

    def send(self, data: bytes, peer: Peer) -> None:
        self.sent.append(peer)

    async def close(self) -> None:
        """Nothing is open."""


class Plane:
    """Sends as one vehicle on one link does."""

    def __init__(self, link: FakeLink, peer: Peer, sysid: int = 3) -> None:
        self.link, self.peer = link, peer
        self.codec = Codec(sysid, 1)

    def say(self, message: Any) -> None:
        self.link.on_bytes(self.codec.pack(message), self.peer)

    def heartbeat(self) -> None:
        self.say(mavlink.MAVLink_heartbeat_message(1, 3, 81, 10, 3, 3))

    def position(self, time_ms: int, lat_e7: int = 465_000_000) -> None:
        self.say(mavlink.MAVLink_global_position_int_message(time_ms, lat_e7, 113_000_000, 0, 0, 0, 0, 0, 0))


class Bench:
    """A fleet on two links, and a clock that stands until it is moved."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.time_s = 100.0
        monkeypatch.setattr(time, "monotonic", lambda: self.time_s)
        self.news: list[str] = []
        self.fleet = Fleet(announce=self.news.append)
        self.radio, self.cable = FakeLink(), FakeLink()
        for link in (self.radio, self.cable):
            self.fleet.attach(link)


@pytest.fixture
def bench(monkeypatch: pytest.MonkeyPatch) -> Bench:
    return Bench(monkeypatch)


def test_a_second_link_stands_by_and_is_not_heard_twice(bench: Bench) -> None:
    planes = [Plane(bench.radio, RADIO), Plane(bench.cable, CABLE)]
    for second in range(20):
        for plane in planes:
            plane.heartbeat()
            plane.position(1000 * second)
        bench.time_s += 1.0
    vehicle = bench.fleet.vehicles[3]
    assert vehicle.peer == RADIO
    assert (vehicle.frames, vehicle.lost_frames) == (40, 0)
    bench.fleet.check()


def test_a_second_link_takes_over_when_the_first_falls_silent(bench: Bench) -> None:
    radio, cable = Plane(bench.radio, RADIO), Plane(bench.cable, CABLE)
    for plane in (radio, cable):
        plane.heartbeat()
    bench.time_s += 2.4
    cable.heartbeat()
    vehicle = bench.fleet.vehicles[3]
    assert vehicle.peer == RADIO
    bench.time_s += 0.2
    cable.heartbeat()
    assert vehicle.peer == CABLE
    assert bench.news == ["vehicle 3: now heard over tcp 127.0.0.1:5760, no longer over serial /dev/ttyUSB0:57600"]
    vehicle.send(mavlink.MAVLink_mission_request_list_message(3, 1, 0))
    assert bench.cable.sent[-1] == CABLE
    bench.time_s += 2.6
    radio.heartbeat()
    assert vehicle.peer == RADIO


def test_a_lost_connection_is_told_and_the_other_link_takes_over_at_once(bench: Bench) -> None:
    cable, radio = Plane(bench.cable, CABLE), Plane(bench.radio, RADIO)
    for plane in (cable, radio):
        plane.heartbeat()
    bench.cable.on_lost(CABLE)
    radio.heartbeat()
    assert bench.fleet.vehicles[3].peer == RADIO
    bench.cable.on_back(CABLE)
    assert bench.news[0] == "tcp 127.0.0.1:5760: connection lost"
    assert bench.news[-1] == "tcp 127.0.0.1:5760: connected"


def test_a_connection_that_comes_back_is_used_again(bench: Bench) -> None:
    cable = Plane(bench.cable, CABLE)
    cable.heartbeat()
    bench.cable.on_lost(CABLE)
    bench.cable.on_back(CABLE)
    cable.heartbeat()
    assert bench.fleet.vehicles[3].frames == 2
    bench.fleet.check()


@pytest.mark.parametrize(("later_ms", "north_e7"), [(60_000, 0), (0, 40_000)])
def test_a_second_vehicle_gives_itself_away_by_its_clock_or_its_place(
    bench: Bench, later_ms: int, north_e7: int
) -> None:
    first, second = Plane(bench.radio, RADIO), Plane(bench.cable, CABLE)
    for number in range(5):
        for plane in (first, second):
            plane.heartbeat()
        first.position(1000 * number)
        second.position(1000 * number + later_ms, 465_000_000 + north_e7)
        bench.time_s += 1.0
    with pytest.raises(InputError, match=r"^system id 3 is used by serial .* and tcp .*; give each vehicle its own$"):
        bench.fleet.check()


def test_two_addresses_of_one_link_are_two_vehicles(bench: Bench) -> None:
    for port in (1, 2):
        Plane(bench.radio, Peer("udp", "127.0.0.1", port)).heartbeat()
    with pytest.raises(InputError, match=r"system id 3 is used by udp 127.0.0.1:1 and udp 127.0.0.1:2"):
        bench.fleet.check()


def test_a_vehicle_may_come_back_at_another_address_after_five_seconds(bench: Bench) -> None:
    Plane(bench.radio, Peer("udp", "127.0.0.1", 1)).heartbeat()
    bench.time_s += 5.1
    Plane(bench.radio, Peer("udp", "127.0.0.1", 2)).heartbeat()
    assert bench.fleet.vehicles[3].peer.port == 2
    bench.fleet.check()


def test_a_restart_of_the_vehicle_and_a_late_link_are_no_second_vehicle(bench: Bench) -> None:
    radio, cable = Plane(bench.radio, RADIO), Plane(bench.cable, CABLE)
    for number in range(20):
        for plane in (radio, cable):
            plane.heartbeat()
        time_ms = 900_000 + 1000 * number if number < 10 else 1000 * number
        cable.position(time_ms)
        radio.position(max(0, time_ms - 3000), 465_000_000 - 900)
        bench.time_s += 1.0
    bench.fleet.check()


def test_addresses_without_a_vehicle_are_forgotten(bench: Bench) -> None:
    Plane(bench.radio, RADIO).heartbeat()
    for number in range(2000):
        peer = Peer("udp", "127.0.0.1", number)
        bench.cable.on_bytes(b"\xfd\x20garbage", peer)
        Plane(bench.cable, peer).heartbeat()
        Plane(bench.cable, peer, sysid=200).say(mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3))
    assert len(bench.fleet._channels) + len(bench.fleet._strangers) < 300
    assert any("further addresses" in line for line in bench.fleet.complaints())


def test_links_are_greeted_before_anything_is_heard(bench: Bench) -> None:
    link = FakeLink()
    link.greeted = (RADIO,)
    bench.fleet.attach(link)
    assert link.sent == [RADIO]


def test_liveness_and_pace(bench: Bench) -> None:
    plane = Plane(bench.radio, RADIO)
    plane.heartbeat()
    for second in range(1, 11):
        bench.time_s += 1.0
        plane.position(50_000 + 4000 * second)
    vehicle = bench.fleet.vehicles[3]
    assert vehicle.pace == pytest.approx(3.6)
    assert vehicle.heard
    bench.time_s += 3.0
    assert not vehicle.heard
    assert vehicle.silent_s == pytest.approx(3.0)


def test_what_did_not_come_through_is_told(bench: Bench) -> None:
    plane = Plane(bench.radio, RADIO)
    plane.heartbeat()
    bench.radio.on_bytes(b"noise", RADIO)
    plane.codec.pack(mavlink.MAVLink_heartbeat_message(1, 3, 81, 10, 3, 3))
    plane.heartbeat()
    assert bench.fleet.complaints() == [
        "serial /dev/ttyUSB0:57600: damaged data 1 times: check the link",
        "vehicle 3: 1 frames lost",
    ]
