"""The README's four commands lead from a scenario file to missions."""

from collections.abc import Callable
from pathlib import Path


def test_four_commands_lead_from_a_scenario_to_missions(
    follow: Callable[[Path], None], folder: Path, root: Path
) -> None:
    follow(root / "README.md")
    assert len(list((folder / "runs/my/missions").glob("*.plan"))) == 9
