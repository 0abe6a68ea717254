"""Where compiled code is kept, and shared functions compiled."""

import os
from pathlib import Path

import numba
import numpy as np
import pytest

from missions.compiled import KEPT_CACHES, cache_folder, compile_shared, sources_hash
from missions.environment import Terrain, ground_height_m
from missions.environment.terrain import NO_WAVE


def test_a_change_of_any_source_changes_the_name(tmp_path: Path) -> None:
    for package in ("missions", "planner"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "a.py").write_text("x = 1\n")
    before = sources_hash(tmp_path)
    assert sources_hash(tmp_path) == before
    (tmp_path / "missions" / "a.py").write_text("x = 2\n")
    changed = sources_hash(tmp_path)
    (tmp_path / "missions" / "a.py").rename(tmp_path / "missions" / "b.py")
    assert len({before, changed, sources_hash(tmp_path)}) == 3


def test_the_oldest_caches_are_removed(tmp_path: Path) -> None:
    for age in range(KEPT_CACHES + 3):
        old = tmp_path / f"old{age}"
        old.mkdir()
        os.utime(old, (1e9 - age, 1e9 - age))
    folder = cache_folder(tmp_path, "new")
    assert folder == tmp_path / "new"
    assert {path.name for path in tmp_path.iterdir()} == {"new", *(f"old{age}" for age in range(KEPT_CACHES))}


def test_a_cache_that_cannot_be_written_falls_back_to_a_temporary_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    folder = cache_folder(tmp_path / "file", "new")
    assert folder.is_dir()
    assert not folder.is_relative_to(tmp_path / "file")


def test_numba_keeps_its_cache_there() -> None:
    compile_shared(ground_height_m)(0.0, 0.0, Terrain(5.0, NO_WAVE, []).as_array())
    assert os.environ["NUMBA_CACHE_DIR"] == numba.config.CACHE_DIR
    assert any(Path(numba.config.CACHE_DIR).rglob("*.nbi"))


def test_a_shared_function_and_its_callees_give_the_same_bits_compiled() -> None:
    wave = (90.0, 0.3, 0.8, 0.5, 1.1, 0.4, 0.9, 0.7)
    terrain = Terrain(5.0, wave, [(500.0, 800.0, 900.0, 700.0, 600.0)])
    compiled = compile_shared(ground_height_m)
    for x, y in np.random.default_rng(0).uniform(-3000, 3000, (200, 2)).tolist():
        assert compiled(x, y, terrain.as_array()) == ground_height_m(x, y, terrain)
    assert compile_shared(ground_height_m) is compiled


def test_the_plain_function_stays_plain() -> None:
    compile_shared(ground_height_m)
    assert not hasattr(ground_height_m, "py_func")
    with pytest.raises(AttributeError):
        ground_height_m.signatures  # type: ignore[attr-defined]  # noqa: B018
