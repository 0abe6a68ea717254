"""`skein import` as a user runs it."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from gcs.cli import app
from missions.formats.mission_file import read_mission_file
from missions.scenario import load_scenario

CORPUS = Path(__file__).parents[1] / "missions" / "formats" / "corpus"


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["import", *map(str, arguments)])


def test_files_of_all_kinds_are_written_as_plans_and_read_back_the_same(tmp_path: Path) -> None:
    files = [CORPUS / "good" / name for name in ("qgc_4.plan", "survey.plan", "mavproxy.txt", "qgc_2.mission")]
    result = run(*files, "--complex", "skip", "--out", tmp_path, "--json")
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert [one["items"] for one in told["files"]] == [6, 4, 3, 4]
    assert told["files"][1]["notes"] == ["mission.items[1]: ComplexItem 'survey' was left out"]
    for source, written in zip(files, told["written"], strict=True):
        again = read_mission_file(Path(written))
        assert repr(again.plan) == repr(read_mission_file(source, complex_items="skip").plan)
        assert again.notes == ()


def test_a_broken_file_ends_it_with_one_line(tmp_path: Path) -> None:
    result = run(CORPUS / "broken" / "duplicate_key.plan", "--out", tmp_path / "none")
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    assert "mission.items[0].frame: stands here twice" in line
    assert not (tmp_path / "none").exists()


def test_the_files_read_are_never_written_over(tmp_path: Path) -> None:
    source = tmp_path / "mine.plan"
    source.write_bytes((CORPUS / "good" / "bare.plan").read_bytes())
    result = run(source, "--out", tmp_path)
    assert result.exit_code == 2
    assert "is one of the files read" in result.stderr
    assert source.read_bytes() == (CORPUS / "good" / "bare.plan").read_bytes()


def test_a_scenario_made_from_files_leads_from_their_homes_to_their_last_places(tmp_path: Path) -> None:
    files = [CORPUS / "good" / name for name in ("qgc_4.plan", "bare.plan")]
    assert run(*files, "--as-scenario", "--out", tmp_path).exit_code == 0
    scenario = load_scenario(str(tmp_path / "qgc_4.toml"))
    assert [vehicle.name for vehicle in scenario.vehicles] == ["qgc_4", "bare"]
    x, y, z = scenario.target_m(scenario.vehicles[0])
    assert scenario.frame.to_e7(x, y) == pytest.approx((474_200_000, 85_300_000), abs=2)
    assert z == 120.0


def test_a_mission_that_stays_at_home_makes_no_scenario(tmp_path: Path) -> None:
    rows = ("0\t1\t0\t16\t0\t0\t0\t0\t47.4\t8.5\t450\t1", "1\t0\t3\t16\t0\t0\t0\t0\t47.4001\t8.5\t60\t1")
    path = tmp_path / "near.waypoints"
    path.write_text("\n".join(("QGC WPL 110", *rows)))
    result = run(path, "--as-scenario", "--out", tmp_path)
    assert result.exit_code == 2
    assert "near: no waypoint at least 300 m from home" in result.stderr
