"""What a vehicle does with keys, and who has no effect on it once it has one."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.codec import Codec
from sitl.services.face import MavlinkFace
from sitl.services.peer import Peer
from sitl.services.signing import Signing, Verdict
from sitl.store import Store

KEY, OTHER_KEY = bytes(range(32)), bytes(range(1, 33))
PEER, OTHER = Peer("tcp", "127.0.0.1", 1000), Peer("udp", "127.0.0.1", 1001)


class Bench:
    """A face with a memory, and what it says to each of two peers."""

    def __init__(self, vehicle: Any, frame: Any) -> None:
        self.vehicle, self.frame = vehicle, frame
        self.store = Store()
        self.restart()

    def restart(self) -> None:
        self.said: dict[Peer, bytes] = {PEER: b"", OTHER: b""}
        self.face = MavlinkFace(self.vehicle, self.frame, self._send, lambda: 50.0, Signing(self.store))
        for peer in self.said:
            self.face.add_peer(peer)

    def _send(self, peer: Peer, data: bytes) -> None:
        self.said[peer] += data

    def hear(self, peer: Peer = PEER) -> list[Any]:
        data, self.said[peer] = self.said[peer], b""
        return Codec(255, 190).feed(data)

    def tell(self, message: Any, signing: Signing | None = None, peer: Peer = PEER) -> None:
        self.face.on_bytes(Codec(255, 190).pack(message, signing), peer)

    def is_loitering_after(self, signing: Signing | None, peer: Peer = PEER) -> bool:
        self.vehicle.change(mode=0)
        self.tell(mavlink.MAVLink_command_long_message(3, 1, 176, 0, 1, 12, 0, 0, 0, 0, 0), signing, peer)
        return bool(self.vehicle.state.mode == 12)


@pytest.fixture
def bench(make_vehicle: Any, frame: Any) -> Bench:
    return Bench(make_vehicle(3), frame)


def setup(key: bytes, timestamp: int = 1, sysid: int = 3) -> Any:
    return mavlink.MAVLink_setup_signing_message(sysid, 1, key, timestamp)


def test_with_a_key_only_signed_messages_have_an_effect_on_any_link(bench: Bench) -> None:
    assert bench.is_loitering_after(None)
    bench.tell(setup(KEY))
    for peer in (PEER, OTHER):
        assert not bench.is_loitering_after(None, peer)
        assert not bench.is_loitering_after(Signing(key=OTHER_KEY), peer)
    assert bench.face.rejected == 4
    assert bench.is_loitering_after(Signing(key=KEY))


def test_traffic_played_again_has_no_effect(bench: Bench) -> None:
    bench.tell(setup(KEY))
    recorded = Codec(255, 190).pack(
        mavlink.MAVLink_command_long_message(3, 1, 176, 0, 1, 12, 0, 0, 0, 0, 0), Signing(key=KEY)
    )
    bench.face.on_bytes(recorded, PEER)
    bench.vehicle.change(mode=0)
    bench.face.on_bytes(recorded, OTHER)
    assert bench.vehicle.state.mode == 0


def test_with_a_key_everything_said_is_signed_on_every_link(bench: Bench) -> None:
    bench.tell(setup(KEY))
    bench.hear(), bench.hear(OTHER)
    bench.face.on_tick()
    bench.face.on_simulated_tick(bench.vehicle.snapshot())
    for peer in (PEER, OTHER):
        station = Signing(key=KEY)
        verdicts = [station.judge(message.get_msgbuf()) for message in bench.hear(peer)]
        assert len(verdicts) > 3
        assert set(verdicts) == {Verdict.GOOD}


def test_the_key_is_kept_over_a_restart(bench: Bench) -> None:
    bench.tell(setup(KEY))
    bench.restart()
    assert not bench.is_loitering_after(None)
    assert bench.is_loitering_after(Signing(key=KEY))


def test_only_who_has_the_key_changes_or_removes_it(bench: Bench) -> None:
    bench.tell(setup(KEY))
    bench.tell(setup(OTHER_KEY))
    bench.tell(setup(bytes(32), 0), Signing(key=OTHER_KEY))
    assert bench.is_loitering_after(Signing(key=KEY))
    bench.tell(setup(OTHER_KEY), Signing(key=KEY))
    assert bench.is_loitering_after(Signing(key=OTHER_KEY))
    bench.tell(setup(bytes(32), 0), Signing(key=OTHER_KEY))
    assert bench.is_loitering_after(None)


def test_keys_for_others_and_for_everyone_are_not_taken(bench: Bench) -> None:
    bench.tell(setup(KEY, sysid=4))
    bench.tell(setup(KEY, sysid=0))
    assert bench.is_loitering_after(None)


@pytest.mark.parametrize(
    ("key", "timestamp", "armed", "reason"),
    [
        (bytes(32), 1, False, "not all of them zero"),
        (KEY, 2**63, False, "more than a year ahead"),
        (KEY, 1, True, "Signing not changed: armed"),
    ],
)
def test_a_refused_key_is_told(bench: Bench, key: bytes, timestamp: int, armed: bool, reason: str) -> None:
    bench.vehicle.change(armed=armed)
    bench.tell(setup(key, timestamp))
    assert reason in "".join(message.text for message in bench.hear())
    assert bench.is_loitering_after(None)
