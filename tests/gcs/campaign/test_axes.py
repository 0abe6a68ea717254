import json
from pathlib import Path
from typing import Any

import pytest

from gcs.campaign.axes import cell_of, labels, make_axes, parse_axis, read_axes, with_values
from missions.errors import InputError
from missions.scenario import Scenario


def test_values_are_held_once_and_as_the_scenario_holds_them(radars: Scenario) -> None:
    axes = make_axes(radars, {"formation.delay_s": [1, 0.2, 1.0], "wind.steady_m_s": [[0, 0], [-3, 4.0]]})
    assert axes == {"formation.delay_s": (1.0, 0.2), "wind.steady_m_s": ((0.0, 0.0), (-3.0, 4.0))}


def test_tables_and_lists_of_tables_are_values_too(radars: Scenario) -> None:
    kill = {"what": "kill", "at_s": 100.0, "vehicles": [3]}
    burst = {"every_s": 20.0, "length_s": 2.0}
    axes = make_axes(
        radars, {"failures": [[], [kill]], "channel.bursts": [burst], "formation.graph": [[[1, 2]], "ring"]}
    )
    changed = with_values(radars, {key: values[-1] for key, values in axes.items()})
    assert [failure.vehicles for failure in changed.failures] == [(3,)]
    assert changed.channel.bursts is not None
    assert changed.channel.bursts.length_s == 2.0
    assert [cell_of(value) for value in axes["formation.graph"]] == ["[[1,2]]", "ring"]
    assert json.loads(cell_of(axes["failures"][1]))[0] == kill | {"groups": []}
    assert list(labels(axes["failures"]).values()) == ["[]", "#2"]


def test_a_value_takes_the_place_of_the_scenarios_and_nothing_else_changes(radars: Scenario) -> None:
    changed = with_values(radars, {"wind.gusts": "moderate", "arm": "plain", "formation.graph": "star"})
    assert (changed.wind.gusts, changed.formation.graph) == ("moderate", "star")
    assert changed.formation.delay_s == radars.formation.delay_s
    assert (radars.wind.gusts, radars.formation.graph) == ("light", "ring")


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (
            {"limits.separation_m": [100.0]},
            r"limits.separation_m: cannot vary with one plan; what can is arm, formation",
        ),
        ({"wind.forecast_m_s": [[0.0, 1.0]]}, "wind.forecast_m_s: cannot vary with one plan"),
        ({"formation.delay_s": [-1.0]}, r"formation.delay_s: .* got -1.0"),
        ({"formation.delay_s": ["soon"]}, r"formation.delay_s: .* got 'soon'"),
        ({"wind.gusts": ["storm"]}, r"wind.gusts: .* got 'storm'"),
        ({"wind.gusts": "light"}, "wind.gusts: needs a list of values"),
        ({"failures": [[{"what": "kill", "at_s": 1.0, "vehicles": [77]}]]}, r"failures: .* 77"),
        ({"arm": []}, "arm: needs a list of values"),
        ({"arm": ["half"]}, "arm: must be one of full, own_schedule, plain, got 'half'"),
    ],
)
def test_what_cannot_vary_is_refused_by_its_key(radars: Scenario, values: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        make_axes(radars, values)


@pytest.mark.parametrize(
    ("text", "axis"),
    [
        ("formation.delay_s=0.1,0.2", ("formation.delay_s", [0.1, 0.2])),
        ("wind.gusts=light,moderate", ("wind.gusts", ["light", "moderate"])),
        ("wind.steady_m_s=[0,0],[-3,4.5]", ("wind.steady_m_s", [[0, 0], [-3, 4.5]])),
        ('arm="full"', ("arm", ["full"])),
    ],
)
def test_an_option_is_written_as_in_a_scenario_but_for_quotes(text: str, axis: tuple[str, list[Any]]) -> None:
    assert parse_axis(text) == axis


@pytest.mark.parametrize("text", ["formation.delay_s", "=1", "arm="])
def test_an_option_without_key_or_value(text: str) -> None:
    with pytest.raises(InputError, match=f"--vary {text}: must be KEY=VALUE"):
        parse_axis(text)


def test_a_file_has_lists_where_a_scenario_has_values(tmp_path: Path) -> None:
    file = tmp_path / "delays.toml"
    file.write_text('arm = ["full"]\n[formation]\ndelay_s = [0.1, 0.2]\n[wind]\nsteady_m_s = [[0.0, 0.0]]\n')
    assert read_axes(file) == {
        "arm": ["full"],
        "formation.delay_s": [0.1, 0.2],
        "wind.steady_m_s": [[0.0, 0.0]],
    }


def test_a_file_that_is_no_campaign(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none.toml: No such file"):
        read_axes(tmp_path / "none.toml")
    (tmp_path / "bad.toml").write_text("arm = [")
    with pytest.raises(InputError, match=r"bad.toml: not TOML"):
        read_axes(tmp_path / "bad.toml")
