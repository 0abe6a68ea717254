"""The parameter protocol at the vehicle's end."""

import math
from typing import Any

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.parameters import PART_S, PER_PART


def test_one_is_read_by_name_in_any_case_and_by_index(bench: Any) -> None:
    count = len(bench.vehicle.parameters.names)
    for name, index in ((b"wp_radius", -1), (b"", count - 1)):
        (value,) = bench.tell(mavlink.MAVLink_param_request_read_message(3, 1, name, index))
        assert (value.param_id, value.param_value) == ("WP_RADIUS", 90.0)
        assert (value.param_index, value.param_count, value.param_type) == (count - 1, count, 9)
    for name, index in ((b"NONE", -1), (b"", count)):
        (error,) = bench.tell(mavlink.MAVLink_param_request_read_message(3, 1, name, index))
        assert (error.get_type(), error.param_index) == ("PARAM_ERROR", index)


def test_a_list_begins_at_once_and_comes_in_parts_of_a_datagram(bench: Any) -> None:
    parts = [bench.tell(mavlink.MAVLink_param_request_list_message(3, 1))]
    assert len(parts[0]) == PER_PART
    assert not any(message.get_type() == "PARAM_VALUE" for message in bench.tick())
    for _ in range(5):
        values = [message for message in bench.tick(PART_S) if message.get_type() == "PARAM_VALUE"]
        parts += [values] if values else []
    assert [value.param_id for part in parts for value in part] == bench.vehicle.parameters.names
    assert len(parts) == 2


def test_every_station_has_its_own_list(bench: Any) -> None:
    everything = len(bench.vehicle.parameters.names)
    request = mavlink.MAVLink_param_request_list_message(3, 1)
    for peer in (bench.peer, bench.other):
        bench.face.on_bytes(bench.codecs[peer].pack(request), peer)
    bench.face.on_tick()
    bench.time_s += PART_S
    bench.face.on_tick()
    for peer in (bench.peer, bench.other):
        values = [message for message in bench.heard(peer) if message.get_type() == "PARAM_VALUE"]
        assert [value.param_index for value in values] == list(range(everything))


def test_what_is_set_is_told_to_everyone(bench: Any) -> None:
    bench.heard(bench.other)
    (value,) = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"wp_radius", 30.0, 9))
    (same,) = bench.heard(bench.other)
    for told in (value, same):
        assert (told.param_id, told.param_value, told.param_index) == ("WP_RADIUS", 30.0, 65535)


def test_what_cannot_be_set_stays_with_a_word(bench: Any) -> None:
    text, value = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"WP_RADIUS", 0.5, 9))
    assert text.text == "WP_RADIUS must be 1 to 32767, got 0.5"
    assert value.param_value == 90.0
    text, value = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"MIS_TOTAL", 5.0, 9))
    assert text.text == "MIS_TOTAL is read-only"
    assert value.param_value == 0.0
    _, value = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"WP_RADIUS", math.inf, 9))
    assert value.param_value == 90.0


def test_a_name_that_there_is_not_gets_an_error_and_nan_silence(bench: Any) -> None:
    (error,) = bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"NONE", 30.0, 9))
    assert (error.get_type(), error.param_id, error.error) == ("PARAM_ERROR", "NONE", 1)
    assert bench.tell(mavlink.MAVLink_param_set_message(3, 1, b"WP_RADIUS", math.nan, 9)) == []
    assert bench.vehicle.parameters["WP_RADIUS"] == 90.0
