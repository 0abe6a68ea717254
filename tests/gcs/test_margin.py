"""`skein margin` as its users meet it."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from gcs.cli import app
from missions.scenario import read_scenario_text

RADARS, _ = read_scenario_text("radars")
KEYS = {
    "graph", "eigenvalues", "continuous_s", "sampled_s", "aircraft_s", "limiting_mode", "gains", "suggested_gains",
}  # fmt: skip


def skein_margin(*arguments: object) -> tuple[int, str, str]:
    result = CliRunner().invoke(app, ["margin", *map(str, arguments)])
    return result.exit_code, result.stdout, result.stderr


def figures(*arguments: object) -> dict:
    code, out, _ = skein_margin(*arguments, "--json")
    assert code == 0
    return json.loads(out)


def test_json_of_a_scenario() -> None:
    found = figures("radars")
    assert found.keys() >= KEYS
    assert found["graph"] == "ring"
    assert len(found["eigenvalues"]) == 9
    assert found["continuous_s"] == pytest.approx(1.0907, abs=1e-4)
    assert found["aircraft_s"] == pytest.approx(0.698, abs=1e-3)
    assert found["limiting_mode"]["eigenvalue"] == pytest.approx(1.9397, abs=1e-4)
    assert found["gains"] == {"k1": 0.2, "k2": 0.8, "k3": 0.4, "k0": 0.01}
    damping = found["damping"]
    assert damping["suggested"]["decay_rate_per_s"] > 3 * damping["present"]["decay_rate_per_s"]


@pytest.mark.parametrize(("graph", "margin_s"), [("ring", 0.4736), ("complete", 0.1855)])
def test_the_bare_law(graph: str, margin_s: float) -> None:
    found = figures("--linear", "--graph", graph, "--k1", 0.2, "--k2", 1, "--k3", 1)
    assert found["continuous_s"] == pytest.approx(margin_s, abs=5e-5)
    assert found["gains"]["k0"] == 0.0
    assert found["limiting_mode"]["of"] == "continuous"


def test_a_graph_and_pins_of_the_scenario(tmp_path: Path) -> None:
    file = tmp_path / "tree.toml"
    tree = [[1, node] for node in range(2, 6)] + [[5, node] for node in range(6, 10)]
    file.write_text(RADARS.replace('graph = "ring"', f"graph = {tree}\npinned = [5]"))
    found = figures(file)
    assert (found["graph"], found["edges"], found["pinned"]) == ("edges", tree, [5])
    assert [mode["eigenvalue"] for mode in found["modes"]] == [None], "its modes do not separate"
    everyone = figures(file, "--pinned", "all")
    assert len(everyone["modes"]) > 1
    assert found["aircraft_s"] == pytest.approx(everyone["aircraft_s"], rel=0.1)


def test_more_vehicles_than_the_scenario_has_and_another_delay() -> None:
    found = figures("vee", "--count", 12, "--graph", "line", "--suggest", 0.41)
    assert found["vehicles"] == list(range(1, 13))
    assert found["delay_s"] == pytest.approx(0.44)
    assert found["damping"]["suggested"]["aircraft_s"] > 0.44


def test_tables_fit_80_columns() -> None:
    for arguments in (("radars",), ("--linear", "--graph", "star", "--pinned", "1"), ("--count", "40")):
        code, out, _ = skein_margin(*arguments)
        assert code == 0
        assert max(map(len, out.splitlines())) <= 80
        for word in ("continuous", "sampled", "aircraft", "Limiting mode", "present", "suggested"):
            assert word in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nowhere",), "nowhere: no such file, nor a scenario that ships"),
        (("--pinned", "1,12"), "--pinned 1,12: there is no vehicle 12"),
        (("--pinned", "some"), "--pinned some: give all, none, or system ids with commas"),
    ],
)
def test_what_cannot_be_is_one_line_and_2(arguments: tuple[str, ...], message: str) -> None:
    code, out, err = skein_margin(*arguments)
    assert (code, out) == (2, "")
    (line,) = err.splitlines()
    assert message in line


def test_a_graph_in_parts_names_them(tmp_path: Path) -> None:
    file = tmp_path / "apart.toml"
    file.write_text(
        RADARS.replace('graph = "ring"', "graph = [[1, 2], [2, 3], [4, 5], [5, 6], [6, 7], [7, 8], [8, 9]]")
    )
    code, out, err = skein_margin(file)
    assert (code, out) == (2, "")
    assert "not connected (lambda_2 = 0), its parts are 1, 2, 3 | 4, 5, 6, 7, 8, 9; join them with edges" in err
