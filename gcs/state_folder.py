"""The folder in which the vehicles of one `skein sim` keep what they remember over restarts: one user at a time."""

import os
import sys
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

from gcs.file_lock import lock
from missions.errors import InputError

LOCK = "in-use"


def default_state_folder(scenario: str, instance: int) -> Path:
    """Of a scenario's swarm, for each user and instance of `skein sim`."""
    base = os.environ.get("XDG_STATE_HOME") or os.environ.get("LOCALAPPDATA") or Path.home() / ".local" / "state"
    return Path(base) / "skein" / "sim" / f"{scenario}-{instance}"


class StateFolder:
    """A state folder, made if need be and locked while this context lasts. A lock dies with the process that holds it.

    Args:
        path: of the folder; in it each vehicle has one of its own, named for its system id.

    Raises:
        InputError: another process uses it, or it cannot be made.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lock = path / LOCK
        try:
            path.mkdir(parents=True, exist_ok=True)
            self._file = self._locked()
        except OSError as error:
            raise InputError(f"{error.filename or path}: {error.strerror}; choose another --state") from error

    def wipe(self) -> None:
        """Forget what all vehicles knew.

        Raises:
            InputError: a vehicle's folder holds what no vehicle has put there; nothing has been removed.
        """
        folders = [one for one in sorted(self.path.iterdir()) if one.name.isdecimal() and one.is_dir()]
        for folder in folders:
            for strange in (one for one in folder.iterdir() if one.is_dir()):
                raise InputError(f"{strange}: no vehicle made this; --wipe touches nothing beside it")
        for folder in folders:
            for piece in folder.iterdir():
                piece.unlink()
            folder.rmdir()

    def _locked(self) -> BinaryIO:
        while True:
            file = self._lock.open("a+b")
            if not lock(file):
                file.seek(0)
                holder = file.read().decode(errors="replace").strip()
                file.close()
                raise InputError(
                    f"{self.path}: in use by another simulation (process {holder}); "
                    "give this one --instance 1, or another --state"
                )
            if self._lock.exists() and os.path.samestat(os.fstat(file.fileno()), self._lock.stat()):
                file.truncate(0)
                file.write(f"{os.getpid()}\n".encode())
                file.flush()
                return file
            file.close()  # the last holder has just removed it

    def __enter__(self) -> "StateFolder":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if sys.platform != "win32":  # there a file in use cannot be removed
            self._lock.unlink(missing_ok=True)
        self._file.close()
