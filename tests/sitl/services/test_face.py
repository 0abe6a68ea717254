"""What a station sees of a vehicle: the whole face, without a socket."""

import math
from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.events import ItemReached, StatusText
from sitl.modes import Mode
from sitl.services.codec import Codec
from sitl.services.face import MavlinkFace
from sitl.services.peer import Peer

PEER, OTHER = Peer("tcp", "127.0.0.1", 1000), Peer("udp", "127.0.0.1", 1001)


class Bench:
    """A face, its vehicle, a clock, and one station on each of two peers."""

    def __init__(self, vehicle: Any, frame: Any) -> None:
        self.vehicle = vehicle
        self.time_s = 50.0
        self.codecs = {peer: Codec(255, 190) for peer in (PEER, OTHER)}
        self.pieces: dict[Peer, list[bytes]] = {PEER: [], OTHER: []}
        self.face = MavlinkFace(vehicle, frame, self._send, lambda: self.time_s)
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

    def command(self, number: int, *params: float) -> tuple[int, list[Any]]:
        """Send COMMAND_LONG and COMMAND_INT; the result, which must agree, and what else came after the former."""
        seven = params + (0.0,) * (7 - len(params))
        *others, ack = self.tell(mavlink.MAVLink_command_long_message(3, 1, number, 1, *seven))
        *_, ack_int = self.tell(mavlink.MAVLink_command_int_message(3, 1, 0, number, 0, 0, *seven[:4], 0, 0, 0.0))
        assert ack.get_type() == ack_int.get_type() == "COMMAND_ACK"
        assert (ack.command, ack.target_system, ack.target_component) == (number, 255, 190)
        assert ack_int.result == ack.result
        return ack.result, others


@pytest.fixture
def bench(make_vehicle: Any, make_mission: Callable[[int], Any], frame: Any) -> Bench:
    vehicle = make_vehicle(3)
    vehicle.mission = make_mission(5)
    return Bench(vehicle, frame)


def kinds(messages: list[Any]) -> list[str]:
    return [message.get_type() for message in messages]


def test_a_heartbeat_each_second_of_wall_time_to_every_peer(bench: Bench) -> None:
    for _ in range(50):
        bench.face.on_tick()
        bench.time_s += 0.1
    assert kinds(bench.heard(PEER)) == kinds(bench.heard(OTHER)) == ["HEARTBEAT"] * 5


@pytest.mark.parametrize(
    ("changes", "base_mode", "custom_mode", "status"),
    [
        ({}, 81, 0, 3),
        ({"mode": Mode.AUTO}, 89, 10, 3),
        ({"mode": Mode.AUTO, "armed": True}, 217, 10, 3),
        ({"mode": Mode.LOITER, "armed": True, "airborne": True}, 217, 12, 4),
    ],
)
def test_the_heartbeat_is_arduplanes(
    bench: Bench, changes: dict[str, Any], base_mode: int, custom_mode: int, status: int
) -> None:
    bench.vehicle.change(**changes)
    bench.face.on_tick()
    (beat,) = bench.heard()
    assert (beat.type, beat.autopilot, beat.get_srcSystem(), beat.get_srcComponent()) == (1, 3, 3, 1)
    assert (beat.base_mode, beat.custom_mode, beat.system_status) == (base_mode, custom_mode, status)


def test_the_streams_of_a_tick_leave_in_one_piece_without_a_gap(bench: Bench) -> None:
    for tick in range(76):
        bench.vehicle.change(time_s=tick * 0.04)
        bench.face.on_simulated_tick(bench.vehicle.snapshot())
    assert len(bench.pieces[PEER]) == 4
    messages = bench.heard()
    assert {"ATTITUDE", "GLOBAL_POSITION_INT", "VFR_HUD", "WIND", "MISSION_CURRENT"} < set(kinds(messages))
    assert [message.get_seq() for message in messages] == [index % 256 for index in range(len(messages))]


def test_events_go_to_every_peer(bench: Bench) -> None:
    bench.vehicle.events = [ItemReached(2), StatusText(6, "reached the target " * 4)]
    bench.face.on_simulated_tick(bench.vehicle.snapshot())
    for peer in (PEER, OTHER):
        messages = [m for m in bench.heard(peer) if m.get_type() in ("MISSION_ITEM_REACHED", "STATUSTEXT")]
        assert kinds(messages) == ["MISSION_ITEM_REACHED", "STATUSTEXT", "STATUSTEXT"]
        assert messages[0].seq == 2


def test_answers_go_to_the_peer_that_asked(bench: Bench) -> None:
    assert kinds(bench.tell(mavlink.MAVLink_mission_request_list_message(3, 1, 0))) == ["MISSION_COUNT"]
    assert bench.heard(OTHER) == []


def test_arming(bench: Bench) -> None:
    assert bench.command(400, 1)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.state.armed
    bench.vehicle.change(airborne=True)
    result, (text,) = bench.command(400, 0)
    assert (result, text.text) == (mavlink.MAV_RESULT_FAILED, "in flight")
    assert bench.command(400, 0.5)[0] == mavlink.MAV_RESULT_DENIED


def test_modes(bench: Bench) -> None:
    assert bench.command(176, 1, 12)[0] == mavlink.MAV_RESULT_ACCEPTED
    assert bench.vehicle.state.mode == Mode.LOITER
    result, (text,) = bench.command(176, 1, 15)
    assert (result, text.text) == (mavlink.MAV_RESULT_FAILED, "No mode 15: there are MANUAL 0, AUTO 10, LOITER 12")
    assert bench.command(176, 0, 10)[0] == mavlink.MAV_RESULT_DENIED
    assert bench.command(176, 1, math.nan)[0] == mavlink.MAV_RESULT_DENIED
    assert bench.tell(mavlink.MAVLink_set_mode_message(3, 1, 10)) == []
    assert bench.vehicle.state.mode == Mode.AUTO
    assert bench.command(300)[0] == mavlink.MAV_RESULT_ACCEPTED


def test_messages_on_request(bench: Bench) -> None:
    for message_id in (30, 33, 42, 49, 242):
        result, (message,) = bench.command(512, message_id)
        assert (result, message.get_msgId()) == (mavlink.MAV_RESULT_ACCEPTED, message_id)
    for number, params in ((512, (148,)), (520, (1,))):
        result, (version,) = bench.command(number, *params)
        assert (result, version.uid) == (mavlink.MAV_RESULT_ACCEPTED, 3)
        assert version.capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT
        assert not version.capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FENCE
    assert bench.command(512, 65_000)[0] == mavlink.MAV_RESULT_FAILED
    assert bench.command(512, math.nan)[0] == mavlink.MAV_RESULT_FAILED


def test_message_intervals(bench: Bench) -> None:
    assert bench.command(511, 30, 100_000)[0] == mavlink.MAV_RESULT_ACCEPTED
    result, (interval,) = bench.command(510, 30)
    assert (result, interval.message_id, interval.interval_us) == (mavlink.MAV_RESULT_ACCEPTED, 30, 100_000)
    for message_id, interval_us in ((30, 1.0), (30, -5.0), (30, math.nan), (65_000, 1e6)):
        assert bench.command(511, message_id, interval_us)[0] == mavlink.MAV_RESULT_DENIED
    assert bench.command(510, 65_000)[0] == mavlink.MAV_RESULT_FAILED


def test_unknown_commands_are_unsupported_and_other_targets_silent(bench: Bench) -> None:
    assert bench.command(31_000)[0] == mavlink.MAV_RESULT_UNSUPPORTED
    assert bench.tell(mavlink.MAVLink_command_long_message(4, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0)) == []
    assert bench.tell(mavlink.MAVLink_command_long_message(3, 100, 400, 0, 1, 0, 0, 0, 0, 0, 0)) == []
    assert not bench.vehicle.state.armed
    everyone = mavlink.MAVLink_command_long_message(0, 0, 400, 0, 1, 0, 0, 0, 0, 0, 0)
    assert kinds(bench.tell(everyone)) == ["COMMAND_ACK"]


def test_timesync_is_answered_and_ping_is_not(bench: Bench) -> None:
    (answer,) = bench.tell(mavlink.MAVLink_timesync_message(0, 1234))
    assert (answer.tc1, answer.ts1) == (50_000_000_000, 1234)
    assert bench.tell(mavlink.MAVLink_timesync_message(5, 1234)) == []
    assert bench.tell(mavlink.MAVLink_ping_message(0, 1, 0, 0)) == []


def test_a_parameter_is_read_by_name_in_any_case_and_by_index(bench: Bench) -> None:
    for name, index in ((b"wp_radius", -1), (b"", 45)):
        (value,) = bench.tell(mavlink.MAVLink_param_request_read_message(3, 1, name, index))
        assert (value.param_id, value.param_value, value.param_index, value.param_count) == ("WP_RADIUS", 90.0, 46, 47)
    assert bench.tell(mavlink.MAVLink_param_request_read_message(3, 1, b"NONE", -1)) == []
    assert bench.tell(mavlink.MAVLink_param_request_read_message(3, 1, b"", 47)) == []


def test_a_list_of_parameters_comes_in_parts_and_whole(bench: Bench) -> None:
    bench.tell(mavlink.MAVLink_param_request_list_message(3, 1))
    names, parts = [], 0
    for _ in range(10):
        bench.face.on_tick()
        values = [message for message in bench.heard() if message.get_type() == "PARAM_VALUE"]
        parts += bool(values)
        names += [value.param_id for value in values]
    assert names == bench.vehicle.parameters.names
    assert parts == 3


def test_a_parameter_is_set_within_its_range_or_left_with_a_word(bench: Bench) -> None:
    (value,) = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"WP_RADIUS", 30.0, 9))
    assert (value.param_value, value.param_index) == (30.0, 65535)
    text, value = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"WP_RADIUS", 0.5, 9))
    assert text.text == "WP_RADIUS must be 1 to 32767, got 0.5"
    assert value.param_value == 30.0
    text, value = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"MIS_TOTAL", 5.0, 9))
    assert text.text == "MIS_TOTAL is read-only"
    assert value.param_value == 0.0
    assert bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"NONE", 30.0, 9)) == []


def test_garbage_is_counted_and_survived(bench: Bench) -> None:
    bench.face.on_bytes(b"\xfd\x00garbage" * 50, PEER)
    assert bench.face.skipped_bytes > 100
    last = [bench.tell(mavlink.MAVLink_timesync_message(0, 1)) for _ in range(20)][-1]
    assert kinds(last) == ["TIMESYNC"]


def test_a_peer_that_is_gone_is_sent_nothing(bench: Bench) -> None:
    bench.face.remove_peer(OTHER)
    bench.face.on_tick()
    assert (len(bench.heard(PEER)), len(bench.heard(OTHER))) == (1, 0)
