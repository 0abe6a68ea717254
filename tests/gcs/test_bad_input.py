"""What a user may get wrong: one clear line, exit code 2, nothing left behind."""

import socket
import subprocess
import sys
from pathlib import Path

import pytest

from missions.scenario import read_scenario_text

MOUNTAINS, _ = read_scenario_text("mountains")


def complaint(*arguments: object) -> str:
    """The one line that a command complains in before it exits with 2; what it did until then, it may tell before."""
    command = [sys.executable, "-m", "gcs.main", *map(str, arguments)]
    result = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert result.returncode == 2, result.stderr
    assert result.stdout == ""
    *steps, line = result.stderr.strip().splitlines()
    assert line.startswith("skein: ")
    assert not [step for step in steps if step.startswith(("skein: ", "Traceback", " "))]
    return line


def test_a_scenario_that_does_not_exist() -> None:
    assert "nowhere.toml: no such file, nor a scenario that ships" in complaint("demo", "nowhere.toml")


def test_a_bad_key(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text(MOUNTAINS.replace("height_m = 500.0", 'height_m = "high"', 1))
    assert "bad.toml: terrain.peaks[0].height_m: must be a number, got 'high'" in complaint("plan", file)


def test_a_target_inside_a_mountain(tmp_path: Path) -> None:
    file = tmp_path / "inside.toml"
    file.write_text(MOUNTAINS.replace("target = [25000.0, 24000.0, 2500.0]", "target = [30000.0, 30000.0, 1000.0]"))
    assert "vehicles[3].target: 750 m inside the ground" in complaint("demo", file, "--out", tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("command", ["fly", "export", "rehearse"])
def test_a_folder_that_is_no_run(command: str, tmp_path: Path) -> None:
    options = ["--format", "plan"] if command == "export" else []
    assert "scenario.toml: No such file or directory; is" in complaint(command, tmp_path, *options)


def test_a_plan_that_was_tampered_with(tmp_path: Path) -> None:
    (tmp_path / "scenario.toml").write_text(MOUNTAINS)
    (tmp_path / "plan.json").write_text('{"format": 2}')
    assert "plan.json: not a plan" in complaint("fly", tmp_path)


def test_an_output_folder_that_holds_something(tmp_path: Path) -> None:
    (tmp_path / "precious.txt").write_text("keep me")
    assert "is not empty; name a new folder with --out" in complaint("demo", "vee", "--out", tmp_path)


def test_an_output_folder_that_is_a_file(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("")
    assert "is a file" in complaint("plan", "vee", "--out", file)


def test_an_output_folder_that_cannot_be_made() -> None:
    assert "choose a folder that can be written to" in complaint("plan", "vee", "--out", "/proc/skein")


def test_a_port_in_use() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        line = complaint("sim", "vee", "--tcp-port", port)
    assert f"TCP port {port}: Address already in use" in line
    assert "--instance 1" in line


def test_more_vehicles_than_system_ids() -> None:
    assert "250" in complaint("sim", "vee", "--count", 300)


def test_an_unknown_method(tmp_path: Path) -> None:
    assert "pso" in complaint("plan", "radars", "--method", "magic", "--out", tmp_path / "run")


def test_both_comparisons_at_once(tmp_path: Path) -> None:
    line = complaint("demo", "vee", "--no-corrections", "--no-neighbours", "--out", tmp_path / "run")
    assert "choose one of them" in line
