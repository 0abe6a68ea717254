"""What `skein console` refuses before it serves anything."""

from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

from gcs.cli import app


@pytest.mark.parametrize("host", ["planes.invalid", "192.0.2.1"])
def test_an_address_that_is_not_this_machines_is_bad_input(flown_path: Path, host: str) -> None:
    result = CliRunner().invoke(app, ["console", str(flown_path), "--host", host])
    assert result.exit_code == 2, result.output
    assert f"--host {host}" in result.stderr


@pytest.mark.parametrize("option", [["--fly"], ["--speed", "5"], ["--delay", "0.4"], ["--seed", "3"], ["--out", "x"]])
def test_vehicles_that_are_there_fly_as_they_do(option: list[str]) -> None:
    result = CliRunner().invoke(app, ["console", "--connect", "udpin://127.0.0.1:14550", *option])
    assert result.exit_code == 2
    assert "the vehicles fly as they do" in result.stderr


def test_a_planned_run_is_flown_where_it_is(flown_path: Path) -> None:
    result = CliRunner().invoke(app, ["console", str(flown_path), "--fly", "--out", "elsewhere"])
    assert result.exit_code == 2
    assert "is planned already" in result.stderr


def test_where_no_vehicle_is_heard_it_says_so(free_port: Callable[[], int]) -> None:
    result = CliRunner().invoke(app, ["console", "--connect", f"udpin://127.0.0.1:{free_port()}"])
    assert result.exit_code == 2, result.output
