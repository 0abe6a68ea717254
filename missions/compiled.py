"""numba for planner and rehearsal: a cache that notices every change of the sources, and plain functions compiled.

Import this file before numba: it says where numba keeps compiled code.
"""

import atexit
import hashlib
import os
import shutil
import tempfile
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

PACKAGES = ("gcs", "missions", "planner", "sitl")
KEPT_CACHES = 4
"""Caches of other versions of the sources that are left in place; older ones are removed."""


def sources_hash(root: Path) -> str:
    """A name for the present state of all sources of the four packages below `root`.

    numba looks only at the file of the function it compiles, not at those of the functions called from it.
    """
    digest = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def cache_folder(base: Path, name: str) -> Path:
    """The folder `name` in `base`, made and marked as used; the oldest others are removed.

    Falls back to a temporary folder, which goes with the process, when `base` cannot be written.
    """
    folder = base / name
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.touch()
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError:
        temporary = Path(tempfile.mkdtemp(prefix="skein-numba-"))
        atexit.register(shutil.rmtree, temporary, ignore_errors=True)
        return temporary
    others = [path for path in base.iterdir() if path != folder]
    for old in sorted(others, key=_last_used, reverse=True)[KEPT_CACHES:]:
        shutil.rmtree(old, ignore_errors=True)
    return folder


def _last_used(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:  # another process has just removed it
        return 0.0


def _user_cache() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or os.path.expanduser("~/.cache")  # noqa: PTH111 (never raises, unlike Path.home)
    return Path(base) / "skein" / "numba"


os.environ["NUMBA_CACHE_DIR"] = str(cache_folder(_user_cache(), sources_hash(Path(__file__).parents[1])))

# Threads that wait for their next share of a population sleep instead of spinning: with another program on one of two
# cores, spinning made planning three times as slow.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")

import numba  # noqa: E402

numba.config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]  # type: ignore[attr-defined]  # if imported before

jit: Callable[..., Any] = numba.njit(cache=True, error_model="python", nogil=True)
"""Compile a kernel's function: cached, division and indices as in Python, no fast mathematics. Threads run it side by
side."""
parallel_jit: Callable[..., Any] = numba.njit(cache=True, error_model="python", parallel=True)
"""The same, with `prange` over all cores."""
prange = numba.prange


def compiled_before(folder: str) -> bool:
    """Whether anything of the sources in folders of this name has been compiled and kept: until then, the first use
    takes some 20 s longer."""
    return any(Path(os.environ["NUMBA_CACHE_DIR"]).glob(f"{folder}_*/*.nbi"))  # named so by numba


_compiled: dict[types.FunctionType, Any] = {}


def compile_shared(function: Any) -> Any:
    """Compile a plain function of `missions`, with all of the project's functions that it calls.

    numba refuses a call of an undecorated function. So callees are compiled first, and the caller is rebuilt over
    them; the original stays plain, for processes without numba. Follows names imported with `from x import f`.
    """
    if function not in _compiled:
        names = {
            name: compile_shared(value)
            for name in function.__code__.co_names
            if isinstance(value := function.__globals__.get(name), types.FunctionType)
            and value.__module__.partition(".")[0] in PACKAGES
        }
        rebuilt = types.FunctionType(
            function.__code__, {**function.__globals__, **names}, function.__name__, function.__defaults__
        )
        rebuilt.__qualname__, rebuilt.__module__ = function.__qualname__, function.__module__
        _compiled[function] = jit(rebuilt)
    return _compiled[function]
