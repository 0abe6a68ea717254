"""A vehicle's face on the bench, without a socket."""

from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.codec import Codec
from sitl.services.face import MavlinkFace
from sitl.services.peer import Peer

PEER, OTHER = Peer("tcp", "127.0.0.1", 1000), Peer("udp", "127.0.0.1", 1001)


class Bench:
    """A face, its vehicle, a clock, and one station on each of two peers."""

    peer, other = PEER, OTHER

    def __init__(self, vehicle: Any, frame: Any) -> None:
        self.vehicle = vehicle
        self.time_s = 50.0
        self.codecs = {peer: Codec(255, 190) for peer in (PEER, OTHER)}
        self.pieces: dict[Peer, list[bytes]] = {PEER: [], OTHER: []}
        self.face = MavlinkFace(vehicle, frame, self._send, lambda: self.time_s, epoch_s=1.7e9)
        for peer in (PEER, OTHER):
            self.face.add_peer(peer)

    def _send(self, peer: Peer, data: bytes) -> None:
        self.pieces[peer].append(data)

    def heard(self, peer: Peer = PEER) -> list[Any]:
        """What has come to a peer since the last call."""
        data, self.pieces[peer] = b"".join(self.pieces[peer]), []
        return self.codecs[peer].feed(data)

    def tell(self, message: Any) -> list[Any]:
        self.heard()
        self.face.on_bytes(self.codecs[PEER].pack(message), PEER)
        return self.heard()

    def tick(self, seconds: float = 0.0) -> list[Any]:
        self.heard()
        self.time_s += seconds
        self.face.on_tick()
        return self.heard()

    def refused(self, number: int, *params: float) -> tuple[int, str]:
        """The result and the line that explains it."""
        result, texts = self.command(number, *params)
        return result, "".join(text.text for text in texts)

    def command_int(self, number: int, params: tuple[float, ...], place: tuple[int, int, float], frame: int = 3) -> Any:
        """Send COMMAND_INT; the result, and the texts that explain it."""
        four = params + (0.0,) * (4 - len(params))
        *texts, ack = self.tell(mavlink.MAVLink_command_int_message(3, 1, frame, number, 0, 0, *four, *place))
        return ack.result, [text.text for text in texts]

    def command(self, number: int, *params: float) -> tuple[int, list[Any]]:
        """Send COMMAND_LONG and COMMAND_INT; the result, which must agree, and what else came after the former."""
        seven = params + (0.0,) * (7 - len(params))
        *others, ack = self.tell(mavlink.MAVLink_command_long_message(3, 1, number, 1, *seven))
        *_, ack_int = self.tell(mavlink.MAVLink_command_int_message(3, 1, 0, number, 0, 0, *seven[:4], 0, 0, seven[6]))
        assert ack.get_type() == ack_int.get_type() == "COMMAND_ACK"
        assert (ack.command, ack.target_system, ack.target_component) == (number, 255, 190)
        assert ack_int.result == ack.result
        return ack.result, others


@pytest.fixture
def bench(make_vehicle: Any, make_mission: Callable[[int], Any], frame: Any) -> Bench:
    vehicle = make_vehicle(3)
    vehicle.mission = make_mission(5)
    return Bench(vehicle, frame)
