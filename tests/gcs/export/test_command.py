"""`skein export` as a user runs it."""

import signal
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from gcs.cli import app
from gcs.run_folder import make_run_folder
from missions.formats.qgc_plan_reader import read_plan
from missions.scenario import Scenario, load_scenario, read_scenario_text
from planner.formation_plan import FormationPlan

Export = Callable[..., Result]


@pytest.fixture(scope="module")
def run(plan_by_hand: Callable[[Scenario], FormationPlan], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = make_run_folder(tmp_path_factory.mktemp("runs") / "radars", "radars")
    scenario = load_scenario("radars")
    folder.write_plan(read_scenario_text("radars")[0], scenario, plan_by_hand(scenario))
    return folder.path


@pytest.fixture
def export(run: Path) -> Iterator[Export]:
    terminate = signal.getsignal(signal.SIGTERM)
    yield lambda *arguments: CliRunner().invoke(app, ["export", str(run), *map(str, arguments)])
    signal.signal(signal.SIGTERM, terminate)


def test_a_planned_run_already_holds_the_default_files(run: Path) -> None:
    files = sorted((run / "missions").iterdir())
    assert len(files) == 18
    assert {file.suffix for file in files} == {".plan", ".waypoints"}
    assert len(read_plan(run / "missions" / "1-leader.plan").fence.areas) > 1


def test_files_are_listed_on_standard_output_and_notes_go_to_standard_error(export: Export, tmp_path: Path) -> None:
    result = export("--format", "plan", "--frame", "terrain", "--out", tmp_path / "out")
    assert result.exit_code == 0
    assert [Path(line) for line in result.stdout.splitlines()] == sorted((tmp_path / "out").iterdir())
    assert "ground is synthetic" in result.stderr
    assert all(line.startswith("skein: ") for line in result.stderr.splitlines())


def test_another_choice_goes_into_a_folder_of_its_own(export: Export, run: Path) -> None:
    before = (run / "missions" / "1-leader.plan").read_bytes()
    result = export("--format", "plan", "--autopilot", "px4", "--frame", "relative", "--landing")
    assert result.exit_code == 0, result.stderr
    folder = run / "missions" / "px4-relative-landing"
    assert len(list(folder.iterdir())) == 9
    assert (run / "missions" / "1-leader.plan").read_bytes() == before


@pytest.mark.parametrize("file_format", ["kml", "czml", "geojson"])
def test_maps_need_no_choice_of_autopilot(export: Export, tmp_path: Path, file_format: str) -> None:
    result = export("--format", file_format, "--out", tmp_path)
    assert result.exit_code == 0
    assert len(list(tmp_path.glob(f"*.{file_format}"))) == 10
    assert result.stderr == ""


def test_what_px4_does_not_take_is_bad_input(export: Export, tmp_path: Path) -> None:
    result = export("--format", "waypoints", "--autopilot", "px4", "--frame", "terrain", "--out", tmp_path)
    assert result.exit_code == 2
    assert result.stderr.startswith("skein: vehicle 1: terrain: PX4 refuses")
    assert list(tmp_path.iterdir()) == []


def test_a_run_s_file_that_cannot_be_written_is_named(export: Export, tmp_path: Path) -> None:
    (tmp_path / "1-leader.kml").mkdir()
    result = export("--format", "kml", "--out", tmp_path)
    assert result.exit_code == 2
    assert "1-leader.kml" in result.stderr
