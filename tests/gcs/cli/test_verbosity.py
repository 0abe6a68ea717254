"""-v says more on standard error, wherever it stands, and changes nothing else; what nobody foresaw is told briefly."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import Result

import gcs.margin

Skein = Callable[..., Result]


@pytest.mark.parametrize("words", [["-v", "margin", "vee", "--json"], ["margin", "vee", "--json", "-v"]])
def test_v_says_more_on_standard_error_and_leaves_standard_output_alone(skein: Skein, words: list[str]) -> None:
    usual, verbose = skein("margin", "vee", "--json"), skein(*words)
    assert usual.exit_code == verbose.exit_code == 0
    assert usual.stdout == verbose.stdout
    assert usual.stderr == ""
    assert "numpy" in verbose.stderr
    assert "Computing margins: " in verbose.stderr


def test_vv_says_more_than_v_and_nothing_stays_for_the_next_command(skein: Skein, run_folder: Path) -> None:
    lines = []
    for flags in (["-v"], ["-v", "-v"], []):
        result = skein("export", run_folder, "--format", "plan", *flags)
        assert result.exit_code == 0
        lines.append(result.stderr.count(" written\n"))
    assert lines[0] == lines[2] == 0
    assert lines[1] == 3


def test_v_tells_of_links_vehicles_and_transfers(swarm: Any) -> None:
    result = swarm("params", "get", "RTL_ALTITUDE", "-v", "--vehicle", "2")
    assert result.exit_code == 0
    assert f"{swarm.tcp[2]}: opening" in result.stderr
    assert "vehicle 2 found at tcp 127.0.0.1:" in result.stderr
    assert "vehicle 2: ParameterRead done" in result.stderr


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch) -> None:
    def figures(study: object) -> None:
        raise ZeroDivisionError("no one\nforesaw this")

    monkeypatch.setattr(gcs.margin.MarginStudy, "figures", figures)


@pytest.mark.usefixtures("broken")
def test_a_fault_of_skein_s_own_is_one_line_and_exit_code_70(skein: Skein) -> None:
    result = skein("margin", "vee", "--json")
    assert result.exit_code == 70
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    assert line.startswith("skein: ZeroDivisionError: no one foresaw this: ")
    assert "report" in line
    assert "-v" in line


@pytest.mark.usefixtures("broken")
def test_v_shows_where_a_fault_is(skein: Skein) -> None:
    result = skein("margin", "vee", "--json", "-v")
    assert result.exit_code == 70
    assert "test_verbosity.py" in result.stderr
    assert "ZeroDivisionError" in result.stderr


def test_the_version_is_that_of_skein_and_of_what_a_flight_depends_on(skein: Skein) -> None:
    result = skein("--version")
    assert result.exit_code == 0
    names = [line.split(" ")[0] for line in result.stdout.splitlines()]
    assert names[0] == "skein-gcs"
    assert {"Python", "numpy", "pymavlink"} <= set(names)
