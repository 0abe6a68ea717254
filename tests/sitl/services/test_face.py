"""What a station sees of a vehicle: the whole face, without a socket."""

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.events import ItemReached, StatusText
from sitl.modes import Mode
from sitl.parameters import Parameters
from sitl.services.codec import Codec
from sitl.store import Store


def kinds(messages: list[Any]) -> list[str]:
    return [message.get_type() for message in messages]


def test_a_heartbeat_each_second_of_wall_time_to_every_peer(bench: Any) -> None:
    for _ in range(50):
        bench.face.on_tick()
        bench.time_s += 0.1
    assert kinds(bench.heard(bench.peer)) == kinds(bench.heard(bench.other)) == ["HEARTBEAT"] * 5


@pytest.mark.parametrize(
    ("changes", "base_mode", "custom_mode", "status"),
    [
        ({}, 81, 0, 3),
        ({"mode": Mode.AUTO}, 89, 10, 3),
        ({"mode": Mode.AUTO, "armed": True}, 217, 10, 3),
        ({"mode": Mode.LOITER, "armed": True, "airborne": True}, 217, 12, 4),
        ({"mode": Mode.RTL, "armed": True, "airborne": True, "failsafe": True}, 217, 11, 5),
    ],
)
def test_the_heartbeat_is_arduplanes(
    bench: Any, changes: dict[str, Any], base_mode: int, custom_mode: int, status: int
) -> None:
    bench.vehicle.change(**changes)
    bench.face.on_tick()
    (beat,) = bench.heard()
    assert (beat.type, beat.autopilot, beat.get_srcSystem(), beat.get_srcComponent()) == (1, 3, 3, 1)
    assert (beat.base_mode, beat.custom_mode, beat.system_status) == (base_mode, custom_mode, status)


def test_the_streams_of_a_tick_leave_in_one_piece_without_a_gap(bench: Any) -> None:
    for tick in range(76):
        bench.vehicle.change(time_s=tick * 0.04)
        bench.face.on_simulated_tick(bench.vehicle.snapshot())
    assert len(bench.pieces[bench.peer]) == 4
    messages = bench.heard()
    assert {"ATTITUDE", "GLOBAL_POSITION_INT", "VFR_HUD", "WIND", "MISSION_CURRENT"} < set(kinds(messages))
    assert [message.get_seq() for message in messages] == [index % 256 for index in range(len(messages))]


def test_events_go_to_every_peer(bench: Any) -> None:
    bench.vehicle.events = [ItemReached(2), StatusText(6, "reached the target " * 4)]
    bench.face.on_simulated_tick(bench.vehicle.snapshot())
    for peer in (bench.peer, bench.other):
        messages = [m for m in bench.heard(peer) if m.get_type() in ("MISSION_ITEM_REACHED", "STATUSTEXT")]
        assert kinds(messages) == ["MISSION_ITEM_REACHED", "STATUSTEXT", "STATUSTEXT"]
        assert messages[0].seq == 2


def test_answers_go_to_the_peer_that_asked(bench: Any) -> None:
    assert kinds(bench.tell(mavlink.MAVLink_mission_request_list_message(3, 1, 0))) == ["MISSION_COUNT"]
    assert bench.heard(bench.other) == []


def test_timesync_is_answered_and_ping_is_not(bench: Any) -> None:
    (answer,) = bench.tell(mavlink.MAVLink_timesync_message(0, 1234))
    assert (answer.tc1, answer.ts1) == (50_000_000_000, 1234)
    assert bench.tell(mavlink.MAVLink_timesync_message(5, 1234)) == []
    assert bench.tell(mavlink.MAVLink_ping_message(0, 1, 0, 0)) == []


def test_garbage_is_counted_and_survived(bench: Any) -> None:
    bench.face.on_bytes(b"\xfd\x00garbage" * 50, bench.peer)
    assert bench.face.skipped_bytes > 100
    last = [bench.tell(mavlink.MAVLink_timesync_message(0, 1)) for _ in range(20)][-1]
    assert kinds(last) == ["TIMESYNC"]


def test_a_peer_that_is_gone_is_sent_nothing(bench: Any) -> None:
    bench.face.remove_peer(bench.other)
    bench.face.on_tick()
    assert (len(bench.heard(bench.peer)), len(bench.heard(bench.other))) == (1, 0)


def test_other_targets_get_silence_and_everyone_means_this_one_too(bench: Any) -> None:
    arm = (400, 0, 1, 0, 0, 0, 0, 0, 0)
    assert bench.tell(mavlink.MAVLink_command_long_message(4, 1, *arm)) == []
    assert bench.tell(mavlink.MAVLink_command_long_message(3, 100, *arm)) == []
    assert not bench.vehicle.state.armed
    assert kinds(bench.tell(mavlink.MAVLink_command_long_message(0, 0, *arm))) == ["COMMAND_ACK"]


def gcs_heartbeat(kind: int = mavlink.MAV_TYPE_GCS) -> Any:
    return mavlink.MAVLink_heartbeat_message(kind, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 4, 3)


def test_the_station_whose_silence_counts_is_mav_gcs_sysid(bench: Any) -> None:
    bench.tell(gcs_heartbeat())
    assert bench.vehicle.asked == [("hear_station", 50.0)]
    bench.tell(gcs_heartbeat(mavlink.MAV_TYPE_FIXED_WING))
    bench.face.on_bytes(Codec(254, 190).pack(gcs_heartbeat()), bench.other)
    assert len(bench.vehicle.asked) == 1
    bench.vehicle.parameters.set("MAV_GCS_SYSID", 254)
    bench.face.on_bytes(Codec(254, 190).pack(gcs_heartbeat()), bench.other)
    assert len(bench.vehicle.asked) == 2
    bench.tick(3.0)
    assert bench.vehicle.watched_at_s == 53.0


def test_a_new_system_id_is_spoken_and_answered_under_at_once(bench: Any) -> None:
    values = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"SYSID_THISMAV", 9.0, 4))
    assert [(value.param_id, value.param_value) for value in values] == [("SYSID_THISMAV", 9.0), ("MAV_SYSID", 9.0)]
    assert {message.get_srcSystem() for message in bench.tick(1.0)} == {9}
    assert bench.tell(mavlink.MAVLink_param_request_read_message(3, 1, b"MAV_SYSID", -1)) == []
    (value,) = bench.tell(mavlink.MAVLink_param_request_read_message(9, 1, b"MAV_SYSID", -1))
    assert value.param_value == 9.0
    assert kinds(bench.tell(mavlink.MAVLink_mission_request_list_message(9, 1, 0))) == ["MISSION_COUNT"]


def test_damage_to_its_memory_is_told_once_to_each_station_that_says_hello(bench: Any) -> None:
    store = Store()
    store.write("parameters.json", b"garbage")
    bench.vehicle.parameters.damage = Parameters([], store).damage
    texts = [message.text for message in bench.tell(gcs_heartbeat()) if message.get_type() == "STATUSTEXT"]
    assert "defaults" in "".join(texts)
    assert bench.tell(gcs_heartbeat()) == []


def test_a_station_that_says_hello_is_shown_everything_though_no_time_passes(bench: Any) -> None:
    shown = set(kinds(bench.tell(gcs_heartbeat())))
    assert {"ATTITUDE", "HOME_POSITION", "MISSION_CURRENT", "CURRENT_MODE", "SYS_STATUS"} < shown
    assert not shown & {"GPS_GLOBAL_ORIGIN", "FENCE_STATUS", "NAMED_VALUE_FLOAT"}
    bench.heard(bench.other)
    assert bench.tell(gcs_heartbeat()) == bench.heard(bench.other) == []


def test_it_says_when_an_upload_has_something_overdue(bench: Any) -> None:
    assert bench.face.deadline_s == math.inf
    bench.tell(mavlink.MAVLink_mission_count_message(3, 1, 4, 0))
    assert bench.time_s < bench.face.deadline_s < bench.time_s + 2.0
    bench.time_s = bench.face.deadline_s
    assert any(message.get_type().startswith("MISSION_REQUEST") for message in bench.tick(0.0))
    assert bench.face.deadline_s > bench.time_s
