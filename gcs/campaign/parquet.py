"""A campaign's table once more as Parquet, with types: numbers are numbers there."""

from collections.abc import Sequence
from pathlib import Path

from gcs.campaign.table import OUTCOME, SEED, Table
from missions.errors import InputError

TEXTS = ("trajectory_sha256",)
WHOLE = (SEED, "arrived", "shortfalls")


def require_parquet() -> None:
    """Raises InputError when the extra is missing."""
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError:
        raise InputError("--parquet: needs pyarrow; pip install 'skein-gcs[parquet]'") from None


def write_parquet(table: Table, path: Path) -> Path:
    """Write all rows; axes are numbers where all their values are. Returns the file. Raises OSError."""
    import pyarrow
    import pyarrow.parquet

    rows = list(table.rows.values())
    arrays = {name: _typed(name, [row[name] for row in rows]) for name in table.columns}
    pyarrow.parquet.write_table(pyarrow.table(arrays), path)
    return path


def _typed(name: str, cells: list[str]) -> Sequence[int | float | str | None]:
    if name in WHOLE:
        return [int(cell) for cell in cells]
    if name in TEXTS:
        return [cell or None for cell in cells]
    try:
        return [float(cell) if cell else None for cell in cells]
    except ValueError:
        assert name not in OUTCOME
        return cells
