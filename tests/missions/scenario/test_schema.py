"""The schema of scenario files: editors must not refuse what the program takes, and the page must be of today."""

import copy
import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from typer.testing import CliRunner

from gcs.cli import app
from missions.errors import InputError
from missions.scenario import parse_scenario, shipped_scenarios
from missions.scenario.manual import manual
from missions.scenario.schema import scenario_schema

PAGE = Path(__file__).parents[3] / "docs" / "scenario.md"


def shipped(name: str) -> str:
    return (files("missions") / "scenarios" / f"{name}.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def validator() -> Draft202012Validator:
    schema = scenario_schema()
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def test_places_may_be_given_by_degrees(validator: Draft202012Validator) -> None:
    values = tomllib.loads((PAGE.parent / "gap.toml").read_text(encoding="utf-8"))
    assert any("lat_deg" in vehicle["target"] for vehicle in values["vehicles"])
    values["obstacles"] = [{"lat_deg": 36.6, "lon_deg": -84.2, "radius_m": 10.0, "height_m": 60.0}]
    assert [error.message for error in validator.iter_errors(values)] == []
    del values["obstacles"][0]["lon_deg"]
    assert list(validator.iter_errors(values))


@pytest.mark.parametrize("name", shipped_scenarios())
def test_the_scenarios_that_ship_are_valid(name: str, validator: Draft202012Validator) -> None:
    assert [error.message for error in validator.iter_errors(tomllib.loads(shipped(name)))] == []


def test_neither_vehicles_of_a_shape_nor_points_of_a_searched_route_need_be_listed(
    validator: Draft202012Validator,
) -> None:
    values = tomllib.loads(shipped("vee"))
    del values["vehicles"], values["route"]["points"]
    values["shape"] = {"pattern": "vee", "count": 3, "spacing_m": 300.0}
    values["route"] |= {"origin": [0.0, 0.0, 0.0], "target": [4000.0, 0.0, 300.0]}
    assert list(validator.iter_errors(values)) == []
    del values["shape"]
    assert list(validator.iter_errors(values))


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        ("limits", "separation_m", "far"),
        ("limits", "separation", 200.0),
        ("limits", "turn_max_deg", 180.0),
        ("formation", "graph", "web"),
        ("wind", "steady_m_s", [1.0]),
        ("search", "waypoints", 2.5),
    ],
)
def test_what_the_schema_refuses_the_program_refuses_too(
    table: str, key: str, value: Any, validator: Draft202012Validator
) -> None:
    values: dict[str, Any] = copy.deepcopy(tomllib.loads(shipped("vee")))
    values.setdefault(table, {})[key] = value
    assert any(list(error.absolute_path)[:1] == [table] for error in validator.iter_errors(values))
    line = f"{key} = {value!r}".replace("'", '"')
    text = shipped("vee")
    head, found, tail = text.partition(f"[{table}]\n")
    text = f"{head}{found}{line}\n{_without(key, tail)}" if found else f"{text}\n[{table}]\n{line}\n"
    with pytest.raises(InputError, match=table):
        parse_scenario(text, "vee.toml", Path())


def _without(key: str, text: str) -> str:
    return "\n".join(line for line in text.splitlines() if not line.startswith(f"{key} ="))


def test_the_page_of_keys_is_of_this_model() -> None:
    assert PAGE.read_text(encoding="utf-8") == manual(), "renew it: skein schema --markdown --out docs/scenario.md"


def test_it_is_written_to_a_file_that_can_be_written(tmp_path: Path) -> None:
    file = tmp_path / "schema.json"
    assert CliRunner().invoke(app, ["schema", "--out", str(file)]).exit_code == 0
    assert '"$schema"' in file.read_text()
    refused = CliRunner().invoke(app, ["schema", "--out", str(tmp_path)])
    assert refused.exit_code == 2
