"""The quick start is true."""

from collections.abc import Callable
from pathlib import Path


def test_it_leads_to_a_flown_run_and_its_report(follow: Callable[[Path], None], folder: Path, root: Path) -> None:
    follow(root / "docs/quick-start.md")
    assert (folder / "runs/first/report.html").stat().st_size > 1_000_000
