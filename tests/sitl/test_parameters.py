"""What is true of a vehicle's parameters: types, ranges, two names of one value, and the memory."""

import json
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.errors import InputError
from missions.mission import as_float32
from sitl.config import VehicleConfig
from sitl.parameters import INT16, REAL, Parameter, Parameters, arduplane_parameters
from sitl.store import Store

PIECE = "parameters.json"
DEFINITIONS = [
    Parameter("WP_RADIUS", INT16, 90, 1, 32767),
    Parameter("MAV_SYSID", INT16, 3, 1, 255),
    Parameter("SYSID_THISMAV", INT16, 3, 1, 255, same_as="MAV_SYSID"),
    Parameter("RTL_ALTITUDE", REAL, 100.0, -1.0, 1e4),
    Parameter("MIS_TOTAL", INT16, 0, 0, 9, read_only=True),
]


@given(st.floats(width=32))
def test_a_value_is_within_its_range_and_float32_whatever_it_is_set_to(value: float) -> None:
    parameters = Parameters(DEFINITIONS, Store())
    try:
        parameters.set("RTL_ALTITUDE", value)
    except InputError:
        assert not -1.0 <= value <= 1e4
        assert parameters["RTL_ALTITUDE"] == 100.0
    else:
        assert parameters["RTL_ALTITUDE"] == as_float32(value) == value


def test_whole_numbers_stay_whole() -> None:
    parameters = Parameters(DEFINITIONS, Store())
    parameters.set("WP_RADIUS", 54.6)
    assert parameters["WP_RADIUS"] == 55.0
    for value in (math.nan, math.inf, -math.inf, 0.0, 40_000.0):
        with pytest.raises(InputError, match="WP_RADIUS must be 1 to 32767"):
            parameters.set("WP_RADIUS", value)


def test_two_names_are_one_value_and_survive_a_restart_as_such(tmp_path: Path) -> None:
    parameters = Parameters(DEFINITIONS, Store(tmp_path))
    parameters.set("SYSID_THISMAV", 7)
    assert parameters["MAV_SYSID"] == parameters["SYSID_THISMAV"] == 7
    parameters.set("MAV_SYSID", 8)
    again = Parameters(DEFINITIONS, Store(tmp_path))
    assert again["MAV_SYSID"] == again["SYSID_THISMAV"] == 8
    assert again.names_of("MAV_SYSID") == again.names_of("SYSID_THISMAV") == ["MAV_SYSID", "SYSID_THISMAV"]
    assert again.names_of("WP_RADIUS") == ["WP_RADIUS"]


def test_what_is_read_only_is_told_by_the_vehicle_alone() -> None:
    parameters = Parameters(DEFINITIONS, Store())
    with pytest.raises(InputError, match="read-only"):
        parameters.set("MIS_TOTAL", 3)
    parameters.tell("MIS_TOTAL", 3)
    assert parameters["MIS_TOTAL"] == 3


@pytest.mark.parametrize("piece", [b"\xff garbage", b"[1, 2]", b"7", b'{"WP_RADIUS": 30', b"null"])
def test_a_damaged_memory_means_defaults_and_a_word(piece: bytes) -> None:
    store = Store()
    store.write(PIECE, piece)
    parameters = Parameters(DEFINITIONS, store)
    assert parameters["WP_RADIUS"] == 90
    assert parameters.damage == "Parameters at defaults: what was kept of them is damaged"
    parameters.set("WP_RADIUS", 30)
    again = Parameters(DEFINITIONS, store)
    assert (again["WP_RADIUS"], again.damage) == (30, None)


def test_a_file_cut_short_is_damage_too(tmp_path: Path) -> None:
    Parameters(DEFINITIONS, Store(tmp_path)).set("WP_RADIUS", 30)
    file = tmp_path / PIECE
    file.write_bytes(file.read_bytes()[:-4])
    parameters = Parameters(DEFINITIONS, Store(tmp_path))
    assert parameters["WP_RADIUS"] == 90
    assert parameters.damage is not None
    assert "damaged" in parameters.damage


def test_bad_values_are_left_out_by_name_and_the_rest_is_kept() -> None:
    store = Store()
    kept = {"WP_RADIUS": 1e9, "MAV_SYSID": "x", "RTL_ALTITUDE": 50.0, "OLD": 1.0, "MIS_TOTAL": 5}
    store.write(PIECE, json.dumps(kept).encode())
    parameters = Parameters(DEFINITIONS, store)
    assert parameters.damage == "At default, as what was kept is damaged: WP_RADIUS, MAV_SYSID"
    assert [parameters[name] for name in ("WP_RADIUS", "MAV_SYSID", "RTL_ALTITUDE", "MIS_TOTAL")] == [90, 3, 50, 0]


def test_every_default_of_arduplanes_is_within_its_range(config: VehicleConfig) -> None:
    definitions = arduplane_parameters(4, config.airframe)
    parameters = Parameters(definitions, Store())
    assert parameters["MAV_SYSID"] == parameters["SYSID_THISMAV"] == 4
    for one in definitions:
        assert len(one.name) <= 16
        assert one.low <= one.default <= one.high, one.name
        assert not one.same_as or one.same_as in parameters
