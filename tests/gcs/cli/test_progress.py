"""Long work shows itself on standard error: at once, and how far it is."""

import io
import subprocess
import sys
from pathlib import Path

import pytest
from rich.console import Console

from gcs.cli import output
from gcs.cli.live import LiveTable
from gcs.cli.progress import working
from gcs.watch import VehicleStatus


def test_a_demo_speaks_before_it_loads_anything_heavy(tmp_path: Path) -> None:
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "file").touch()
    command = [sys.executable, "-X", "importtime", "-m", "gcs.main", "demo", "--out", tmp_path / "taken"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert result.returncode == 2
    assert result.stdout == ""
    lines = [line.rpartition("|")[2].strip() for line in result.stderr.splitlines()]  # the last: a module's name
    spoke = lines.index("Loading planner and simulation")
    for heavy in ("numba", "numpy", "scipy", "planner.plan", "missions.scenario"):
        assert spoke < lines.index(heavy), heavy


def test_away_from_a_terminal_work_is_a_plain_line(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(output, "progress", Console(file=written))
    with working("Counting [geese]", count=3) as bar:
        bar.advance("Counting ducks")
        bar.show(2, 3, note="soon")
    assert written.getvalue() == "Counting [geese]\n"


def test_on_a_terminal_work_shows_its_count_and_the_time_left_and_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(output, "progress", Console(file=written, force_terminal=True, width=80))
    with working("Counting [geese]", count=40, done=10) as bar:
        assert "Counting [geese]" in written.getvalue()
        for _ in range(3):
            bar.advance()
    shown = written.getvalue()
    assert "13/40" in shown
    assert " left" in shown
    assert "Counting" not in shown.rpartition("\r")[2]


def test_work_that_nobody_can_count_shows_how_long_it_has_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(output, "progress", Console(file=written, force_terminal=True, width=80))
    with working("Loading"):
        pass
    assert "0:00 so far" in written.getvalue()
    assert "0/" not in written.getvalue()


def test_a_flight_shows_how_far_it_is_and_the_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    console = Console(file=written, force_terminal=True, width=80)
    with LiveTable(console) as live:
        for time_s in (0.0, 100.0, 250.0):
            live.show([VehicleStatus(i, f"G{i}", 1000.0, 1100.0, 5, time_s=time_s) for i in (1, 2)])
    last = written.getvalue().rpartition("Flying")[2]
    assert "25%" in last
    assert " left" in last


def test_away_from_a_terminal_a_flight_is_its_steps() -> None:
    written = io.StringIO()
    with LiveTable(Console(file=written)) as live:
        live.announce("Launching [9] endpoints")
        live.show([VehicleStatus(1, "G1", 1000.0, 1100.0, 5)])
    assert written.getvalue() == "Launching [9] endpoints\n"
