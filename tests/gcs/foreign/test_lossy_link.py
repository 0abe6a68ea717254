"""Foreign stations upload through a link that drops datagrams of every kind, both ways."""

import contextlib
import random
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from gcs.bench.mavsdk_station import MavsdkStation, peer_module, plugin, to_raw_items
from gcs.bench.peers import LOOPBACK
from missions.formats.waypoints import write_waypoints
from sitl.services.codec import Codec

LOSS = 0.05
SEEDS = range(4)
OLD, NEW = 30, 100
"""Items of the missions."""


def by_chance(seed: int) -> Callable[[bytes], bool]:
    """The datagrams that are lost, as a seed says."""
    chance = random.Random(seed)
    return lambda data: chance.random() < LOSS


class FirstOfAKind:
    """The first datagrams with a message of a kind are lost.

    Attributes:
        left: how many are still to be lost.
    """

    def __init__(self, kind: str, count: int) -> None:
        self._kind = kind
        self._codec = Codec(255, 190)
        self.left = count

    def __call__(self, data: bytes) -> bool:
        lost = self.left > 0 and any(message.get_type() == self._kind for message in self._codec.feed(data))
        self.left -= lost
        return lost


@pytest.mark.parametrize("lost", [1, 2])
def test_mavsdk_learns_that_its_upload_is_whole_though_the_word_of_it_was_lost(
    make_vehicle: Any, make_mission: Any, serve: Any, relay: Any, mavsdk: Any, lost: int
) -> None:
    vehicle, fate = make_vehicle(6), FirstOfAKind("MISSION_ACK", lost)
    link = relay(serve(vehicle).udp_port, fate)
    (system,) = mavsdk(f"udpout://{LOOPBACK}:{link.port}").wait_for([6])
    mission = make_mission(OLD)
    plugin("mission_raw", system).upload_mission(to_raw_items(mission.items))
    assert (vehicle.mission, fate.left) == (mission, 0)


def test_mavsdks_uploads_arrive_and_it_never_believes_in_one_that_did_not(
    make_vehicle: Any, make_mission: Any, serve: Any, relay: Any, mavsdk: Any
) -> None:
    error = peer_module("mavsdk.plugins.mission_raw.mission_raw").MissionRawError

    def upload(seed: int) -> Any:
        vehicle = make_vehicle(6)
        vehicle.mission = make_mission(OLD)
        link = relay(serve(vehicle).udp_port, by_chance(seed))
        station: MavsdkStation = mavsdk(f"udpout://{LOOPBACK}:{link.port}")
        (system,) = station.wait_for([6])
        with contextlib.suppress(error):  # when it has lost too much
            plugin("mission_raw", system).upload_mission(to_raw_items(make_mission(NEW).items))
            assert vehicle.mission == make_mission(NEW)
        assert link.n_dropped > 0
        return vehicle.mission

    with ThreadPoolExecutor(len(SEEDS)) as threads:
        held = list(threads.map(upload, SEEDS))
    assert held == [make_mission(NEW)] * len(SEEDS)


def test_mavproxys_upload_arrives_though_it_gives_no_item_after_the_last(
    make_vehicle: Any, make_mission: Any, serve: Any, relay: Any, mavproxy: Any, tmp_path: Path
) -> None:
    vehicle, mission = make_vehicle(6), make_mission(NEW)
    link = relay(serve(vehicle).udp_port, by_chance(1))
    write_waypoints(mission, tmp_path / "sent.waypoints")
    proxy = mavproxy(f"udpout:{LOOPBACK}:{link.port}")
    proxy.wait_for("online system 6")
    proxy.repeat("wp load sent.waypoints", "Got MISSION_ACK: TYPE_MISSION: ACCEPTED", every_s=10.0)  # for a lost COUNT
    assert link.n_dropped > 0
    assert [item.alt_m for item in vehicle.mission] == pytest.approx([item.alt_m for item in mission])
