"""What the endpoints recorded, or a rehearsal in their place: truth/<sysid>.f64 (MODEL, section 7)."""

import hashlib
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from sitl.truth import shifts_file

FloatArray = npt.NDArray[np.float64]
Truths = Mapping[int, FloatArray]
"""By sysid: (n_tick, 6) rows of x, y, h, V, gamma, chi; row n is the state at tick n. SI, radians, local frame."""

COLUMNS = 6
X, Y, H, V, GAMMA, CHI = range(COLUMNS)


def read_truths(folder: Path, sysids: Iterable[int]) -> dict[int, FloatArray]:
    """The truth of each vehicle, in order of sysid.

    Raises:
        InputError: a file is missing or holds no whole row.
    """
    return {sysid: read_truth(folder / f"{sysid}.f64") for sysid in sorted(sysids)}


def read_truth(path: Path) -> FloatArray:
    """One vehicle's truth, (n_tick, 6). The half row that a killed endpoint may leave is cut.

    Raises:
        InputError: the file is missing or holds no whole row.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; `skein fly` writes it") from None
    row_bytes = COLUMNS * 8
    whole = len(data) - len(data) % row_bytes
    if not whole:
        raise InputError(f"{path}: no whole row of {row_bytes} bytes; the vehicle never flew, fly the run again")
    return np.frombuffer(data[:whole], dtype="<f8").reshape(-1, COLUMNS).astype(np.float64, copy=False)


def read_shifts(folder: Path, sysids: Iterable[int]) -> dict[int, FloatArray]:
    """What vehicles recorded of the swarm's clock, by sysid: (n_tick, 2) rows of seconds that their schedules had been
    slowed and hurried. Without those that recorded nothing of the kind."""
    shifts = {}
    for sysid in sysids:
        file = shifts_file(folder / f"{sysid}.f64")
        if file.is_file():
            data = file.read_bytes()
            shifts[sysid] = np.frombuffer(data[: len(data) // 16 * 16], dtype="<f8").reshape(-1, 2)
    return shifts


def write_shifts(shifts: Truths, folder: Path) -> None:
    """Write what `read_shifts` reads into an existing folder. Raises OSError."""
    for sysid, rows in shifts.items():
        _write(shifts_file(folder / f"{sysid}.f64"), rows)


def write_truths(truths: Truths, folder: Path) -> None:
    """Write each vehicle's truth into an existing folder. Raises OSError."""
    for sysid, rows in truths.items():
        _write(folder / f"{sysid}.f64", rows)


def _write(file: Path, rows: npt.NDArray[np.float64]) -> None:
    """Write rows as they are read; a disk that fills up while it is written to tells no name by itself."""
    try:
        file.write_bytes(rows.astype("<f8", copy=False).tobytes())
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(file)) from None


def trajectory_sha256(truths: Truths, last_tick: int) -> str:
    """SHA-256 over the truth files in order of sysid, each cut after row `last_tick`."""
    digest = hashlib.sha256()
    for sysid in sorted(truths):
        digest.update(truths[sysid][: last_tick + 1].astype("<f8", copy=False).tobytes())
    return digest.hexdigest()
