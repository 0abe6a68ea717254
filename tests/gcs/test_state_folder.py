"""Where a swarm's memory is, whose it is, and how it is forgotten."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gcs.state_folder import StateFolder, default_state_folder
from missions.errors import InputError

HOLDER = """
import sys
from pathlib import Path
from gcs.state_folder import StateFolder
with StateFolder(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_each_scenario_and_instance_has_a_folder_of_its_own(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    folders = {default_state_folder(name, instance) for name in ("vee", "radars") for instance in (0, 1)}
    assert len(folders) == 4
    assert all(folder.is_relative_to(tmp_path / "skein") for folder in folders)


def test_a_second_user_is_refused_and_told_whose_it_is(tmp_path: Path) -> None:
    with (
        StateFolder(tmp_path / "new" / "state") as held,
        pytest.raises(InputError, match=rf"in use by another simulation \(process {os.getpid()}\).*--instance 1"),
    ):
        StateFolder(held.path)


def test_it_is_free_once_its_user_has_done_with_it(tmp_path: Path) -> None:
    for _ in range(2):
        with StateFolder(tmp_path):
            pass
    assert list(tmp_path.iterdir()) == []


def test_it_is_free_when_its_user_was_killed(tmp_path: Path) -> None:
    command = [sys.executable, "-c", HOLDER, str(tmp_path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == b"held\n"
        with pytest.raises(InputError, match=rf"process {holder.pid}\)"):
            StateFolder(tmp_path)
        holder.kill()
    with StateFolder(tmp_path):
        pass


def test_a_file_in_its_place_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"file: .*; choose another --state"):
        StateFolder(tmp_path / "file")


def test_wiping_forgets_the_vehicles_and_nothing_else(tmp_path: Path) -> None:
    for name in ("1/mission.plan", "12/parameters.json", "notes/mine", "7"):
        file = tmp_path / name
        file.parent.mkdir(exist_ok=True)
        file.write_text("kept")
    with StateFolder(tmp_path) as state:
        state.wipe()
    assert sorted(str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*")) == ["7", "notes", "notes/mine"]


def test_wiping_refuses_a_folder_that_no_vehicle_has_made_and_removes_nothing(tmp_path: Path) -> None:
    (tmp_path / "1").mkdir()
    (tmp_path / "1" / "mission.plan").write_text("kept")
    (tmp_path / "2" / "photographs").mkdir(parents=True)
    with StateFolder(tmp_path) as state, pytest.raises(InputError, match=r"photographs: no vehicle made this"):
        state.wipe()
    assert (tmp_path / "1" / "mission.plan").exists()
