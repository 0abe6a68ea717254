"""The endpoint's end of an upload, over links that lose, delay and repeat, with stations of several habits."""

import heapq
import itertools
import random
import statistics
from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.codec import Codec
from sitl.services.mission_items import item_message
from sitl.services.mission_server import MissionServer
from sitl.services.peer import Peer

PEER = Peer("udp", "127.0.0.1", 14550)
SYSID = 3


class AnyOrder:
    """Answers any request, as QGroundControl does; repeats MISSION_COUNT and its last item after a while."""

    patience_s = 0.3

    requests: frozenset[str] = frozenset({"MISSION_REQUEST", "MISSION_REQUEST_INT"})

    def __init__(self, items: Any, send: Callable[[Any], None]) -> None:
        self.items = items
        self.send = send
        self.results: list[int] = []
        self.asked: list[int] = []
        self.spoke_at_s = 0.0

    def on_message(self, message: Any, now_s: float) -> None:
        if message.get_type() in self.requests:
            self.asked.append(message.seq)
            self.on_request(message.seq, now_s)
        elif message.get_type() == "MISSION_ACK":
            self.results.append(message.type)

    def on_request(self, seq: int, now_s: float) -> None:
        self.give(seq, now_s)

    def on_time(self, now_s: float) -> None:
        if now_s - self.spoke_at_s < self.patience_s and now_s > 0.0:
            return
        if not self.asked:
            self.count(now_s)
        elif max(self.asked) == len(self.items) - 1:
            self.give(len(self.items) - 1, now_s)

    def count(self, now_s: float) -> None:
        self.spoke_at_s = now_s
        self.send(mavlink.MAVLink_mission_count_message(SYSID, 1, len(self.items), 0))

    def give(self, seq: int, now_s: float) -> None:
        self.spoke_at_s = now_s
        self.send(item_message(self.items[seq], seq, SYSID, 1))


class Patient(AnyOrder):
    """Knows that its link is slow."""

    patience_s = 1.5


class LikeMavsdk(AnyOrder):
    """Ignores a request ahead of what it expects, goes back to one behind but not often, must end with the last; waits
    for its MISSION_ACK and does nothing for it but give what it is asked for."""

    patience_s = 0.5
    most_tries = 5
    gives_up = -1
    expected = 0
    tries = 0

    def on_request(self, seq: int, now_s: float) -> None:
        if seq > self.expected:
            return
        if seq == self.expected:
            self.tries = 0
        elif self.tries >= self.most_tries:
            self.results.append(self.gives_up)
            return
        self.tries += 1
        self.expected = seq + 1
        self.give(seq, now_s)

    def on_time(self, now_s: float) -> None:
        if now_s - self.spoke_at_s < self.patience_s and now_s > 0.0:
            return
        if self.tries >= self.most_tries:
            self.results.append(self.gives_up)
        self.tries += 1
        self.spoke_at_s = now_s
        if not self.asked:
            self.count(now_s)

    def on_message(self, message: Any, now_s: float) -> None:
        super().on_message(message, now_s)
        if self.results == [mavlink.MAV_MISSION_ACCEPTED]:
            assert self.expected == len(self.items)


class LikeMavproxy(AnyOrder):
    """Knows the old request only, and answers no more once it has given its last item."""

    requests = frozenset({"MISSION_REQUEST"})
    done = False

    def on_request(self, seq: int, now_s: float) -> None:
        if not self.done:
            self.give(seq, now_s)
        self.done = seq == len(self.items) - 1


class Pusher(AnyOrder):
    """Sends an item when the very next is asked for, and repeats it while it is not (Mission Planner)."""

    given = -1

    def on_request(self, seq: int, now_s: float) -> None:
        if seq == self.given + 1:
            self.given = seq
            self.give(seq, now_s)

    def on_time(self, now_s: float) -> None:
        if now_s - self.spoke_at_s >= 0.7 and self.given >= 0:
            self.give(self.given, now_s)
        elif self.given < 0:
            super().on_time(now_s)


class Complaining(AnyOrder):
    """Answers a request out of order with INVALID_SEQUENCE."""

    given = -1

    def on_request(self, seq: int, now_s: float) -> None:
        if seq > self.given + 1:
            self.send(mavlink.MAVLink_mission_ack_message(SYSID, 1, mavlink.MAV_MISSION_INVALID_SEQUENCE, 0))
        else:
            self.given = max(self.given, seq)
            self.give(seq, now_s)


class Link:
    """A server and a station with a link between them; time is simulated."""

    def __init__(
        self, vehicle: Any, station: Any, items: Any, *, loss: float, delay_s: float, jitter_s: float, seed: int
    ) -> None:
        self.random = random.Random(seed)
        self.loss, self.delay_s, self.jitter_s = loss, delay_s, jitter_s
        self.time_s = 0.0
        self.sent = 0
        self._counter = itertools.count()
        self._in_flight: list[tuple[float, int, bool, bytes]] = []
        self._up, self._down = Codec(255, 190), Codec(SYSID, 1)
        self.station = station(items, lambda message: self._put(True, self._up.pack(message)))
        self.server = MissionServer(
            vehicle,
            lambda message, _: self._put(False, self._down.pack(message)),
            lambda status: None,
            lambda: self.time_s,
        )

    def run(self, until_s: float = 200.0) -> float:
        """Until the station has a result; how long that took."""
        while not self.station.results and self.time_s < until_s:
            self.station.on_time(self.time_s)
            self.server.on_tick()
            while self._in_flight and self._in_flight[0][0] <= self.time_s:
                _, _, up, frame = heapq.heappop(self._in_flight)
                if up:
                    for message in self._down.feed(frame):
                        self.server.on_message(message, PEER)
                else:
                    for message in self._up.feed(frame):
                        self.station.on_message(message, self.time_s)
            self.time_s += 0.005
        return self.time_s

    def _put(self, up: bool, frame: bytes) -> None:
        self.sent += 1
        for _ in range(1 if self.random.random() >= self.loss / 5 or not self.jitter_s else 2):
            if self.random.random() >= self.loss:
                delay_s = self.delay_s + self.jitter_s * self.random.random()
                heapq.heappush(self._in_flight, (self.time_s + delay_s, next(self._counter), up, frame))


ODDS = [AnyOrder, LikeMavsdk, LikeMavproxy, Pusher, Complaining]


@pytest.mark.parametrize("station", ODDS)
def test_every_kind_of_station_uploads_over_a_good_link(make_vehicle: Any, make_mission: Any, station: Any) -> None:
    for count in (1, 2, 3, 4, 5, 6, 40):
        vehicle, mission = make_vehicle(SYSID), make_mission(count)
        link = Link(vehicle, station, mission, loss=0.0, delay_s=0.01, jitter_s=0.0, seed=1)
        link.run()
        assert (link.station.results[0], vehicle.mission) == (mavlink.MAV_MISSION_ACCEPTED, mission)
        assert max(link.station.asked) < count


@pytest.mark.parametrize("jitter_s", [0.0, 0.05])
@pytest.mark.parametrize("station", [AnyOrder, LikeMavsdk, Pusher, Complaining])
def test_every_kind_of_station_uploads_over_a_bad_link(
    make_vehicle: Any, make_mission: Any, station: Any, jitter_s: float
) -> None:
    for seed in range(10, 16):  # with 3, LikeMavsdk loses five of its last eight messages and gives up
        vehicle, mission = make_vehicle(SYSID), make_mission(30)
        loss = 0.25 if station is AnyOrder else 0.08
        link = Link(vehicle, station, mission, loss=loss, delay_s=0.05, jitter_s=jitter_s, seed=seed)
        link.run()
        assert (link.station.results[0], vehicle.mission) == (mavlink.MAV_MISSION_ACCEPTED, mission)


def test_a_hundred_items_over_a_quarter_of_loss_take_two_or_three_seconds(make_vehicle: Any, make_mission: Any) -> None:
    mission, took_s = make_mission(100), []
    for seed in range(20):
        vehicle = make_vehicle(SYSID)
        link = Link(vehicle, AnyOrder, mission, loss=0.25, delay_s=0.05, jitter_s=0.0, seed=seed)
        took_s.append(link.run())
        assert vehicle.mission == mission
    assert statistics.median(took_s) < 3.0


def test_without_loss_nothing_is_asked_for_twice_and_a_window_saves_most_round_trips(
    make_vehicle: Any, make_mission: Any
) -> None:
    link = Link(make_vehicle(SYSID), AnyOrder, make_mission(100), loss=0.0, delay_s=0.05, jitter_s=0.0, seed=1)
    assert link.run() < 1.0
    assert sorted(link.station.asked) == list(range(100))


@pytest.mark.parametrize(("station", "most"), [(Patient, 90), (AnyOrder, 130)])
def test_a_slow_link_is_not_filled_with_repeats(make_vehicle: Any, make_mission: Any, station: Any, most: int) -> None:
    link = Link(make_vehicle(SYSID), station, make_mission(60), loss=0.0, delay_s=0.45, jitter_s=0.0, seed=1)
    link.run()
    assert len(link.station.asked) < most
