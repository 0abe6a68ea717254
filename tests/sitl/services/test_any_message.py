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
command = st.sampled_from([16, 17, 22, 178, 400, 176, 300, 512, 511, 510, 520]) | st.integers(0, 2**16 - 1)
frame = st.sampled_from([0, 2, 3, 5, 6]) | byte
kind = st.sampled_from([0, 0, 0, 1, 2, 255])
index = st.integers(-(2**15), 2**15 - 1)

messages = st.one_of(
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
    st.builds(lambda v: mavlink.MAVLink_param_set_message(*US, b"WP_RADIUS", v, 9), real),
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


def test_after_50_simulated_days_it_still_speaks() -> None:
    vehicle = Vehicle(CONFIG, TruthWriter(None))
    vehicle.tick = 50 * 24 * 3600 * 25
    heard: list[bytes] = []
    face = MavlinkFace(vehicle, CONFIG.frame, lambda peer, data: heard.append(data), lambda: 0.0)
    face.add_peer(PEER)
    face.on_simulated_tick(vehicle.snapshot())
    assert any(message.get_type() == "ATTITUDE" for message in Codec(255, 190).feed(b"".join(heard)))
