"""What a vehicle keeps outlives a loss of power at any moment and a failing disk: the old piece or the new, whole."""

import errno
import os
import stat
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from missions.errors import InputError
from sitl import store as store_module
from sitl.store import Store

OLD, NEW = b"old" * 1000, b"new" * 2000
NAME = "mission.plan"


class Disk:
    """What would be left of a folder if the power went now.

    For certain there is only what was brought to the disk: contents by fsync of the file, names by fsync of the folder.
    Of the rest anything may be there, or not.
    """

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self._folder = folder
        self._fsync = os.fsync
        self._names: dict[str, int] = {}
        self._contents: dict[int, bytes] = {}
        monkeypatch.setattr(os, "fsync", self._on_fsync)

    def left(self) -> Iterator[dict[str, bytes]]:
        """All that may be there, by name."""
        there = {entry.name: entry.inode() for entry in os.scandir(self._folder)}
        written = {inode: (self._folder / name).read_bytes() for name, inode in there.items()}
        for names in (self._names, there):
            for part in (0.0, 0.5, 1.0):
                yield {
                    name: self._contents.get(inode) or written[inode][: int(part * len(written[inode]))]
                    for name, inode in names.items()
                }

    def _on_fsync(self, file: int) -> None:
        self._fsync(file)
        status = os.fstat(file)
        there = {entry.inode(): entry for entry in os.scandir(self._folder)}
        if stat.S_ISDIR(status.st_mode):
            self._names = {entry.name: inode for inode, entry in there.items()}
        else:
            self._contents[status.st_ino] = Path(there[status.st_ino].path).read_bytes()


def kept_by(folder: Path, pieces: dict[str, bytes]) -> bytes | None:
    """What a vehicle finds that starts with these files."""
    folder.mkdir(exist_ok=True)
    for file in folder.iterdir():
        file.unlink()
    for name, data in pieces.items():
        (folder / name).write_bytes(data)
    return Store(folder).read(NAME)


@pytest.mark.skipif(sys.platform == "win32", reason="folders cannot be brought to the disk there")
def test_when_the_power_goes_at_any_line_the_old_or_the_new_one_is_left_and_once_it_is_kept_the_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "memory"
    folder.mkdir()
    disk, store = Disk(folder, monkeypatch), Store(folder)
    store.write(NAME, OLD)
    assert {kept_by(tmp_path / "after", left) for left in disk.left()} == {OLD}
    may_be_left: list[dict[str, bytes]] = []

    def at_each_line(frame: Any, event: str, _: Any) -> Any:
        if frame.f_code.co_filename != store_module.__file__:
            return None
        may_be_left.extend(disk.left())
        return at_each_line

    before = sys.gettrace()
    sys.settrace(at_each_line)
    try:
        store.write(NAME, NEW)
    finally:
        sys.settrace(before)
    assert len(may_be_left) > 50
    assert {kept_by(tmp_path / "after", left) for left in may_be_left} == {OLD, NEW}
    assert {kept_by(tmp_path / "after", left) for left in disk.left()} == {NEW}


@pytest.mark.skipif(sys.platform == "win32", reason="folders cannot be brought to the disk there")
def test_the_folders_that_it_makes_are_brought_to_the_disk_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    synced = set()
    monkeypatch.setattr(os, "fsync", lambda file: synced.add(os.fstat(file).st_ino))
    folder = tmp_path / "swarm" / "3"
    Store(folder).write(NAME, OLD)
    assert {one.stat().st_ino for one in (tmp_path, folder.parent, folder, folder / NAME)} == synced


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EROFS, errno.EIO])
@pytest.mark.parametrize("failing", [(Path, "open"), (os, "fsync"), (Path, "replace")])
def test_what_could_not_be_written_is_an_error_with_the_reason_and_the_old_one_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: tuple[Any, str], number: int
) -> None:
    store = Store(tmp_path)
    store.write(NAME, OLD)

    def fail(*_: Any, **__: Any) -> None:
        raise OSError(number, os.strerror(number))

    with monkeypatch.context() as broken:
        broken.setattr(*failing, fail)
        with pytest.raises(InputError, match=f"{os.strerror(number)}; old one kept"):
            store.write(NAME, NEW)
    assert Store(tmp_path).read(NAME) == OLD
    assert [file.name for file in tmp_path.iterdir()] == [NAME]
    store.write(NAME, NEW)
    assert Store(tmp_path).read(NAME) == NEW


@pytest.mark.skipif(sys.platform == "win32", reason="folders cannot be brought to the disk there")
def test_a_folder_that_cannot_be_brought_to_the_disk_is_an_error_unless_the_file_system_has_no_such_thing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    number = errno.EIO
    fsync = os.fsync

    def fail_for_folders(file: int) -> None:
        if stat.S_ISDIR(os.fstat(file).st_mode):
            raise OSError(number, os.strerror(number))
        fsync(file)

    monkeypatch.setattr(os, "fsync", fail_for_folders)
    with pytest.raises(InputError, match="Input/output error; it may be lost when the power goes"):
        Store(tmp_path).write(NAME, NEW)
    assert Store(tmp_path).read(NAME) == NEW
    number = errno.EINVAL
    Store(tmp_path).write(NAME, OLD)
    assert Store(tmp_path).read(NAME) == OLD


def test_a_folder_that_is_none_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "memory").write_text("a file")
    with pytest.raises(InputError, match="memory"):
        Store(tmp_path / "memory").write(NAME, NEW)
