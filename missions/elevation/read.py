"""The raster that a scenario names: `terrain.raster`."""

from pathlib import Path

from missions.elevation.archive import read_archive
from missions.elevation.geodata import read_geodata
from missions.elevation.resample import check_local_cover, resample
from missions.environment import Area
from missions.environment.raster import Raster
from missions.errors import InputError
from missions.frame import LocalFrame

SAMPLE = "matplotlib:"
"""Before the name of a file of matplotlib's sample data."""
GEODATA = (".tif", ".tiff", ".hgt")


def read_raster(name: str, folder: Path, frame: LocalFrame, area: Area, spacing_m: float | None) -> Raster:
    """Posts over the area in the local frame, from a file.

    Args:
        name: a .npz (see `missions.elevation.archive`), .tif, .tiff or .hgt file, relative to `folder` or absolute; or
            one of matplotlib's sample data as "matplotlib:jacksboro_fault_dem.npz".
        spacing_m: between posts; about the file's own unless given.

    Raises:
        InputError: the file cannot be used; the message names it, as the scenario does, and the reason.
    """
    try:
        path = _sample(name.removeprefix(SAMPLE)) if name.startswith(SAMPLE) else folder / name
        if not path.is_file():
            raise InputError(f"no such file in {folder.resolve()}; a path counts from the scenario's folder")
        suffix = path.suffix.lower()
        if suffix != ".npz" and suffix not in GEODATA:
            raise InputError(f"must be a .npz, {', '.join(GEODATA)} file")
        found = read_archive(path) if suffix == ".npz" else read_geodata(path)
        if isinstance(found, Raster):
            check_local_cover(found, area)
            return found
        return resample(found, frame, area, spacing_m)
    except InputError as error:
        raise InputError(f"{name}: {error}") from None
    except OSError as error:
        raise InputError(f"{name}: {error.strerror or error}") from None


def _sample(name: str) -> Path:
    """A file of matplotlib's sample data."""
    from matplotlib import get_data_path

    path = Path(get_data_path()) / "sample_data" / name
    if not path.is_file():
        raise InputError("no such file in matplotlib's sample data")
    return path
