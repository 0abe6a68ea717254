import hashlib
import math
from pathlib import Path

import numpy as np
import pytest

from gcs.truth import read_shifts, read_truth, read_truths, trajectory_sha256, write_shifts
from missions.errors import InputError
from sitl.formation.swarm_clock import UNSHIFTED, Shift, Shifts
from sitl.truth import TruthWriter

ROW_BYTES = 48


def write(path: Path, rows: int, start: float = 0.0) -> np.ndarray:
    values = start + np.arange(rows * 6, dtype=np.float64).reshape(rows, 6) / 7.0
    writer = TruthWriter(path)
    for row in values.tolist():
        writer.write(tuple(row), UNSHIFTED)
    writer.close()
    return values


def test_what_the_swarms_clock_did_stands_beside_it(tmp_path: Path) -> None:
    writer = TruthWriter(tmp_path / "4.f64", shifts=True)
    for n in range(20):
        writer.write((0.0,) * 6, Shifts(Shift(0.1 * n, 0.0, 0.0), Shift(0.3 * n, 0.0, 0.0)))
    writer.close()
    write(tmp_path / "5.f64", 20)
    read = read_shifts(tmp_path, [4, 5])
    assert list(read) == [4]
    np.testing.assert_array_equal(read[4], np.arange(20)[:, None] * [0.1, 0.3])
    (tmp_path / "copy").mkdir()
    write_shifts(read, tmp_path / "copy")
    np.testing.assert_array_equal(read_shifts(tmp_path / "copy", [4])[4], read[4])


def test_reads_back_what_an_endpoint_writes(tmp_path: Path) -> None:
    values = write(tmp_path / "3.f64", 50)
    assert (tmp_path / "3.f64").stat().st_size == 50 * ROW_BYTES
    np.testing.assert_array_equal(read_truth(tmp_path / "3.f64"), values)


def test_files_are_little_endian_whatever_the_machine(tmp_path: Path) -> None:
    (tmp_path / "1.f64").write_bytes(b"\x00\x00\x00\x00\x00\x00\xf8\x3f" * 6)
    np.testing.assert_array_equal(read_truth(tmp_path / "1.f64"), np.full((1, 6), 1.5))


def test_cuts_the_half_row_of_a_killed_vehicle(tmp_path: Path) -> None:
    values = write(tmp_path / "1.f64", 20)
    path = tmp_path / "1.f64"
    path.write_bytes(path.read_bytes()[: 12 * ROW_BYTES + 31])
    np.testing.assert_array_equal(read_truth(path), values[:12])


def test_says_which_file_is_missing_or_empty(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"7\.f64: No such file"):
        read_truth(tmp_path / "7.f64")
    (tmp_path / "8.f64").write_bytes(b"x" * (ROW_BYTES - 1))
    with pytest.raises(InputError, match=r"8\.f64: no whole row"):
        read_truth(tmp_path / "8.f64")


def test_comes_in_order_of_sysid(tmp_path: Path) -> None:
    for sysid in (10, 9, 2):
        write(tmp_path / f"{sysid}.f64", 3, float(sysid))
    assert list(read_truths(tmp_path, [10, 9, 2])) == [2, 9, 10]


def test_hash_is_over_the_files_in_order_of_sysid_cut_after_the_last_tick(tmp_path: Path) -> None:
    for sysid in (10, 9, 2):
        write(tmp_path / f"{sysid}.f64", 30, float(sysid))
    truths = read_truths(tmp_path, [10, 9, 2])
    data = b"".join((tmp_path / f"{sysid}.f64").read_bytes()[: 18 * ROW_BYTES] for sysid in (2, 9, 10))
    assert trajectory_sha256(truths, 17) == hashlib.sha256(data).hexdigest()
    reversed_order = {sysid: truths[sysid] for sysid in (10, 9, 2)}
    assert trajectory_sha256(reversed_order, 17) == trajectory_sha256(truths, 17)


def test_hash_sees_the_last_bit_of_the_last_row_and_nothing_after_it(tmp_path: Path) -> None:
    values = write(tmp_path / "1.f64", 30)
    before = trajectory_sha256({1: values}, 17)
    after_the_cut = values.copy()
    after_the_cut[18:] += 1.0
    assert trajectory_sha256({1: after_the_cut}, 17) == before
    in_the_last_row = values.copy()
    in_the_last_row[17, 5] = math.nextafter(values[17, 5], math.inf)
    assert trajectory_sha256({1: in_the_last_row}, 17) != before
