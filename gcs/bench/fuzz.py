"""Both ends under hostile traffic: they neither break nor grow."""

import resource
import time
from dataclasses import dataclass
from itertools import islice

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs import station
from gcs.bench.hostile_traffic import hostile_traffic
from gcs.fleet import Fleet
from gcs.links.link import OnBytes, OnPeer, ignore_bytes, ignore_peer
from missions.scenario import load_scenario
from sitl.services.codec import Codec
from sitl.services.face import MavlinkFace
from sitl.services.links import MOST_STRANGERS
from sitl.services.peer import Peer
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

_ADDRESSES = 1_000_000
_SYSIDS = range(1, 51)
_SYSID_AT = 5
"""In a frame of version 2."""
_PIECES_A_TURN = 20
_TURN_S = 0.05


@dataclass(frozen=True)
class Fuzzed:
    """What it took.

    Attributes:
        pieces: sent, a frame each for the most part.
        through: messages that the station heard, or datagrams that the endpoint said.
        seconds: wall time.
        grown_mb: by how much the largest memory of the process grew after the first fifth.
    """

    pieces: int
    through: int
    seconds: float
    grown_mb: float


def fuzz_endpoint(pieces: int, seed: int) -> Fuzzed:
    """Send so many pieces to a vehicle's face, whose clocks go on meanwhile."""
    config = vehicle_configs(load_scenario("radars"), SwarmOptions(seed=1, delay_s=0.2))[0]
    vehicle = Vehicle(config, TruthWriter(None))
    wall_s, answered = [0.0], [0]

    def send(peer: Peer, data: bytes) -> None:
        answered[0] += 1

    face = MavlinkFace(vehicle, config.frame, send, lambda: wall_s[0])
    peers = [Peer("udp", "127.0.0.1", port) for port in range(1, MOST_STRANGERS + 1)]

    def turn(number: int) -> None:
        wall_s[0] += _TURN_S
        face.remove_peer(peers[number % len(peers)])
        face.on_tick()
        vehicle.observe()
        vehicle.advance({})
        if face.wants(vehicle.tick * _TURN_S):
            face.on_simulated_tick(vehicle.snapshot())

    meter = _Meter(pieces)
    for number, piece in enumerate(islice(hostile_traffic(seed, (config.sysid, 1), range(1, 256)), pieces)):
        face.on_bytes(piece, peers[number % 3 if number % 5 else number // 5 % len(peers)])
        if number % _PIECES_A_TURN == 0:
            turn(number // _PIECES_A_TURN)
        meter.tick(number)
    return meter.result(answered[0])


def fuzz_station(pieces: int, seed: int) -> Fuzzed:
    """Send so many pieces to a fleet on two links, from fifty vehicles' addresses and a million others."""
    fleet = Fleet()
    heartbeat = mavlink.MAVLink_heartbeat_message(1, 3, 217, 10, 4, 3)
    links = [_QuietLink(), _QuietLink()]
    for link in links:
        fleet.attach(link)
    for sysid in _SYSIDS:
        links[0].on_bytes(Codec(sysid, 1).pack(heartbeat), Peer("udp", "127.0.0.1", sysid))
    meter = _Meter(pieces)
    traffic = hostile_traffic(seed, (station.SYSID, station.COMPID), _SYSIDS)
    for number, piece in enumerate(islice(traffic, pieces)):
        own = number % 3 and len(piece) > _SYSID_AT
        address = piece[_SYSID_AT] if own else number % _ADDRESSES
        links[number % 4 == 0].on_bytes(piece, Peer("udp", "127.0.0.1", address))
        if number % 5000 == 0:
            fleet.complaints()
            for vehicle in fleet.vehicles.values():
                vehicle.send(station.heartbeat())
                for message in vehicle.latest.values():
                    repr(message)
        meter.tick(number)
    return meter.result(sum(vehicle.frames for vehicle in fleet.vehicles.values()))


class _Meter:
    """Time and memory of one run."""

    def __init__(self, pieces: int) -> None:
        self._pieces = pieces
        self._began_s = time.monotonic()
        self._first_mb = 0.0

    def tick(self, number: int) -> None:
        if number == self._pieces // 5:
            self._first_mb = _largest_mb()

    def result(self, through: int) -> Fuzzed:
        return Fuzzed(self._pieces, through, time.monotonic() - self._began_s, _largest_mb() - self._first_mb)


class _QuietLink:
    """A link without a socket."""

    on_bytes: OnBytes
    on_lost: OnPeer
    on_back: OnPeer

    def __init__(self) -> None:
        self.on_bytes = ignore_bytes
        self.on_lost = self.on_back = ignore_peer
        self.greeted: tuple[Peer, ...] = ()

    def send(self, data: bytes, peer: Peer) -> None:
        """Nobody is there."""

    async def close(self) -> None:
        """Nothing is open."""


def _largest_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
