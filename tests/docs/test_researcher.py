"""The researchers' tutorial is true."""

from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.mark.timeout(600)
def test_its_flights_repeat_and_compare_as_it_says(follow: Callable[[Path], None], root: Path) -> None:
    follow(root / "docs/researcher.md")
