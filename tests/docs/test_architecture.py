"""What the pages on the code name is there."""

import re
from pathlib import Path

import pytest

NAMED = re.compile(r"`((?:gcs|planner|sitl|missions|tests|docs)/[\w./-]*)`")
LINED = re.compile(r"-> ((?:gcs|planner|sitl|missions)/[\w./-]*)")


@pytest.mark.parametrize("name", ["architecture.md", "mathematics.md", "planner.md", "researcher.md"])
def test_files_and_folders_that_a_page_names_exist(name: str, root: Path) -> None:
    text = (root / "docs" / name).read_text(encoding="utf-8")
    found = [*NAMED.findall(text), *LINED.findall(text)]
    assert found
    for path in found:
        assert (root / path).exists(), f"{name}: there is no {path}"


def test_every_package_and_its_folders_are_on_the_page_of_the_house(root: Path) -> None:
    text = (root / "docs/architecture.md").read_text(encoding="utf-8")
    for package in ("gcs", "planner", "sitl", "missions"):
        assert f"`{package}/`" in text
