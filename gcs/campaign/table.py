"""A campaign's table on the disk, runs.csv: a row a flight, appended as it ends.

A campaign may be killed at any time: a row counts once its line is whole, and a second start flies what is missing.
"""

import csv
import io
import os
import time
from collections.abc import Sequence
from dataclasses import astuple, fields
from pathlib import Path
from types import TracebackType
from typing import Any

from gcs.campaign.axes import cell_of
from gcs.campaign.case import Case, Flown, Outcome
from gcs.file_lock import lock
from missions.errors import InputError

SEED = "seed"
OUTCOME = tuple(field.name for field in fields(Outcome))
SYNC_S = 2.0
"""How often rows are brought to the disk: what a failing machine may lose."""

Row = dict[str, str]


class Table:
    """The rows of a campaign, read and open to append. A context manager.

    Args:
        path: of the file; made if need be. A last line that is not whole is cut off.
        axes: keys that have columns, before the seed's.

    Attributes:
        rows: what is there, by the cells of `key_of`.

    Raises:
        InputError: the file is no table with these columns, cannot be written to, or another process has it open.
    """

    def __init__(self, path: Path, axes: Sequence[str]) -> None:
        self.columns = (*axes, SEED, *OUTCOME)
        self._keys = len(axes) + 1
        try:
            self._file = path.open("a+b")
            if not lock(self._file):
                raise InputError(f"{path}: in use by another process; wait for it, or name a new folder with --out")
            self.rows = self._read(path)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from None
        self._synced_s = time.monotonic()

    def _read(self, path: Path) -> dict[tuple[str, ...], Row]:
        self._file.seek(0)
        text = self._file.read()
        whole = text.rfind(b"\n") + 1
        self._file.truncate(whole)
        lines = list(csv.reader(io.StringIO(text[:whole].decode(), newline="")))
        if not lines:
            self._append(self.columns)
            return {}
        if tuple(lines[0]) != self.columns or any(len(line) != len(self.columns) for line in lines):
            raise InputError(f"{path}: not the table of this campaign; name a new folder with --out")
        return {tuple(line[: self._keys]): dict(zip(self.columns, line, strict=True)) for line in lines[1:]}

    def row_of(self, case: Case) -> Row | None:
        """The row of a flight, if there is one."""
        return self.rows.get(key_of(case))

    def append(self, flown: Flown) -> None:
        """Add the row of a flight."""
        cells = (*key_of(flown.case), *("" if cell is None else str(cell) for cell in astuple(flown.outcome)))
        self._append(cells)
        self.rows[cells[: self._keys]] = dict(zip(self.columns, cells, strict=True))
        if time.monotonic() - self._synced_s > SYNC_S:
            os.fsync(self._file.fileno())
            self._synced_s = time.monotonic()

    def _append(self, cells: Sequence[Any]) -> None:
        line = io.StringIO(newline="")
        csv.writer(line, lineterminator="\n").writerow(cells)
        self._file.write(line.getvalue().encode())
        self._file.flush()

    def __enter__(self) -> "Table":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        os.fsync(self._file.fileno())
        self._file.close()


def key_of(case: Case) -> tuple[str, ...]:
    """The cells that tell a flight from all others: the axes' values and the seed."""
    return (*(cell_of(value) for _, value in case.values), str(case.seed))
