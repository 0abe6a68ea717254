from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gcs.campaign.case import Case, Flown, Outcome
from gcs.campaign.table import Table
from missions.errors import InputError

AXES = ("wind.steady_m_s", "arm")


def flown(seed: int, wind: tuple[float, float] = (-3.0, 4.0)) -> Flown:
    outcome = Outcome(3, 0.1 * seed, None, 0.2, 119.0, 30.0, 14.0, None, 0, "ab" * 32)
    return Flown(Case((("wind.steady_m_s", wind), ("arm", "full")), seed), outcome)


def written(path: Path, seeds: range) -> bytes:
    with Table(path, AXES) as table:
        for seed in seeds:
            table.append(flown(seed))
    return path.read_bytes()


def test_rows_are_found_again_by_values_and_seed(tmp_path: Path) -> None:
    written(tmp_path / "runs.csv", range(1, 4))
    with Table(tmp_path / "runs.csv", AXES) as table:
        row = table.row_of(flown(2).case)
        assert row is not None
        assert (row["seed"], row["wind.steady_m_s"], row["arm"]) == ("2", "[-3.0,4.0]", "full")
        assert float(row["rms_error_m"]) == 0.1 * 2
        assert row["min_wall_m"] == ""
        assert table.row_of(flown(4).case) is None
        assert table.row_of(flown(2, wind=(0.0, 0.0)).case) is None


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return written(tmp_path_factory.mktemp("table") / "runs.csv", range(1, 6))


@settings(deadline=None, max_examples=50)
@given(cut=st.integers(0, 700))
def test_wherever_a_write_was_cut_off_whole_rows_are_kept_and_the_rest_can_follow(
    cut: int, whole: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("cut") / "runs.csv"
    path.write_bytes(whole[:cut])
    with Table(path, AXES) as table:
        kept = len(table.rows)
        assert kept == max(0, whole[:cut].count(b"\n") - 1)
        for seed in range(kept + 1, 6):
            table.append(flown(seed))
    assert path.read_bytes() == whole


def test_other_columns_are_another_table(tmp_path: Path) -> None:
    written(tmp_path / "runs.csv", range(1, 2))
    with pytest.raises(InputError, match="not the table of this campaign"):
        Table(tmp_path / "runs.csv", ("arm",))


def test_two_at_once_would_fly_everything_twice(tmp_path: Path) -> None:
    with Table(tmp_path / "runs.csv", AXES), pytest.raises(InputError, match=r"runs.csv: in use by another process"):
        Table(tmp_path / "runs.csv", AXES)
    written(tmp_path / "runs.csv", range(1, 2))
