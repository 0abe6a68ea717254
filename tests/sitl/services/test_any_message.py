"""Whatever fields a station puts into its messages, the vehicle answers or is silent; it never breaks."""

import math
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.scenario import load_scenario
from sitl.services.codec import Codec
from sitl.services.face import MavlinkFace
from sitl.services.peer import Peer
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

CONFIG = vehicle_configs(load_scenario("radars"), SwarmOptions(seed=1, delay_s=0.2))[0]
US = (CONFIG.sysid, 1)
PEER = Peer("tcp", "127.0.0.1", 1)

real = st.floats(width=32) | st.sampled_from([math.nan, math.inf, -math.inf, 1e10, 0.0, 1.0, -1.0, -2.0])
byte = st.integers(0, 255)
seq = st.integers(0, 4) | st.integers(0, 2**16 - 1)
angle_e7 = st.integers(-(2**31), 2**31 - 1) | st.sampled_from([0, 470_000_000, 470_100_000, 80_000_000])
command = st.sampled_from(
    [16, 17, 20, 21, 22, 176, 178, 179, 192, 207, 224, 262, 300, 400, 401, 410, 510, 511, 512, 520]
) | st.integers(0, 2**16 - 1)
frame = st.sampled_from([0, 2, 3, 5, 6]) | byte
kind = st.sampled_from([0, 0, 0, 1, 2, 255])
index = st.integers(-(2**15), 2**15 - 1)

parameter = st.sampled_from([name.encode() for name in Vehicle(CONFIG, TruthWriter(None)).parameters.names])


def of_the_dialect(message_id: int, payload: bytes) -> Any:
    """Any message at all, to this vehicle if it is to anyone."""
    kind = mavlink.mavlink_map[message_id]
    raw, sender = mavlink.MAVLink_message(message_id, kind.msgname), mavlink.MAVLink(None, 255, 190)
    payload = payload[: kind.unpacker.size].ljust(kind.unpacker.size, b"\1")
    message = sender.decode(bytearray(raw._pack(sender, kind.crc_extra, payload)))
    for name, value in (("target_system", US[0]), ("target_component", US[1])):
        if hasattr(message, name):
            setattr(message, name, value)
    return message


messages = st.one_of(
    st.builds(of_the_dialect, st.sampled_from(sorted(mavlink.mavlink_map)), st.binary(max_size=255)),
    st.builds(lambda n, t: mavlink.MAVLink_mission_count_message(*US, n, t), seq, kind),
    st.builds(
        lambda *f: mavlink.MAVLink_mission_item_int_message(*US, *f),
        seq, frame, command, byte, byte, real, real, real, real, angle_e7, angle_e7, real, kind,
    ),
    st.builds(
        lambda *f: mavlink.MAVLink_mission_item_message(*US, *f),
        seq, frame, command, byte, byte, real, real, real, real, real, real, real, kind,
    ),
    st.builds(lambda n, t: mavlink.MAVLink_mission_request_int_message(*US, n, t), seq, kind),
    st.builds(lambda n, t: mavlink.MAVLink_mission_request_message(*US, n, t), seq, kind),
    st.builds(lambda t: mavlink.MAVLink_mission_request_list_message(*US, t), kind),
    st.builds(lambda t: mavlink.MAVLink_mission_clear_all_message(*US, t), kind),
    st.builds(lambda r, t: mavlink.MAVLink_mission_ack_message(*US, r, t), byte, kind),
    st.builds(lambda c, n, *p: mavlink.MAVLink_command_long_message(*US, c, n, *p), command, byte, *[real] * 7),
    st.builds(
        lambda fr, c, *p: mavlink.MAVLink_command_int_message(*US, fr, c, 0, 0, *p),
        frame, command, real, real, real, real, angle_e7, angle_e7, real,
    ),
    st.builds(lambda i: mavlink.MAVLink_param_request_read_message(*US, b"WP_RADIUS", i), index),
    st.builds(lambda n, v: mavlink.MAVLink_param_set_message(*US, n, v, 9), parameter, real),
    st.builds(lambda n: mavlink.MAVLink_mission_set_current_message(*US, n), seq),
    st.builds(lambda *f: mavlink.MAVLink_request_data_stream_message(*US, *f), byte, st.integers(0, 2**16 - 1), byte),
    st.builds(lambda kind: mavlink.MAVLink_heartbeat_message(kind, 8, 0, 0, 0, 3), st.sampled_from([6, 1])),
    st.builds(lambda b, m: mavlink.MAVLink_set_mode_message(US[0], b, m), byte, st.integers(0, 2**32 - 1)),
    st.builds(lambda a, b: mavlink.MAVLink_timesync_message(a, b), *[st.integers(-(2**63), 2**63 - 1)] * 2),
)  # fmt: skip


@settings(max_examples=400, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(messages, min_size=1, max_size=12))
def test_no_sequence_of_messages_breaks_a_vehicle(sent: list[Any]) -> None:
    vehicle = Vehicle(CONFIG, TruthWriter(None))
    wall_s = [100.0]
    face = MavlinkFace(vehicle, CONFIG.frame, lambda peer, data: None, lambda: wall_s[0])
    station = Codec(255, 190)
    for message in sent:
        face.on_bytes(station.pack(message), PEER)
        wall_s[0] += 1.0
        face.on_tick()
        vehicle.observe()
        vehicle.advance({})
        face.on_simulated_tick(vehicle.snapshot())


@settings(max_examples=100)
@given(st.lists(st.tuples(messages, st.integers(0, 300), st.integers(0, 255)), max_size=8))
def test_no_frame_cut_short_or_changed_breaks_a_vehicle(sent: list[tuple[Any, int, int]]) -> None:
    face = MavlinkFace(Vehicle(CONFIG, TruthWriter(None)), CONFIG.frame, lambda peer, data: None, lambda: 0.0)
    station = Codec(255, 190)
    for message, at, byte in sent:
        frame = station.pack(message)
        face.on_bytes(frame[:at], PEER)
        face.on_bytes(frame[:at] + bytes([byte]) + frame[at + 1 :], PEER)
        face.on_tick()


def test_after_50_simulated_days_it_still_speaks() -> None:
    vehicle = Vehicle(CONFIG, TruthWriter(None))
    vehicle.tick = 50 * 24 * 3600 * 25
    heard: list[bytes] = []
    face = MavlinkFace(vehicle, CONFIG.frame, lambda peer, data: heard.append(data), lambda: 0.0)
    face.add_peer(PEER)
    face.on_simulated_tick(vehicle.snapshot())
    assert any(message.get_type() == "ATTITUDE" for message in Codec(255, 190).feed(b"".join(heard)))
