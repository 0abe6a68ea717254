"""The engineers' tutorial is true: its programs are kept and run against swarms."""

from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.mark.timeout(600)
def test_its_programs_fly_the_vehicles_that_it_says(follow: Callable[[Path], None], root: Path) -> None:
    pytest.importorskip("mavsdk")
    follow(root / "docs/engineer.md")
