"""Whatever command a page names there is, with the options that it gives it; blocks that are not run say why."""

import re
import shlex
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from gcs.cli import app

NAMED = re.compile(r"^(?: {4})?(?:\.venv/bin/)?skein ([^\n]*)|`skein ([^`]*)`", re.M)


@pytest.fixture(scope="module")
def commands() -> dict[str, Any]:
    """All of `skein`, by name; some are groups of more. Each becomes itself when there is a use for it."""
    later = typer.main.get_command(app).commands
    return {name: one.make_context(name, [], resilient_parsing=True).command for name, one in later.items()}


def named(page: Path) -> Iterator[list[str]]:
    """The words after `skein`, of each time that it is named with a command."""
    for match in NAMED.finditer(page.read_text(encoding="utf-8")):
        text = re.sub(r"[\[\]]", "", match[1] or match[2] or "").replace("\n", " ")
        words = shlex.split(text.partition(" | ")[0], comments=True)
        if words and words[0].isalpha() and words[0].islower():
            yield words


def options_of(command: Any) -> set[str]:
    return {name for parameter in command.params for name in parameter.opts + parameter.secondary_opts}


def test_commands_and_options_that_pages_name_exist(pages: list[Path], commands: dict[str, Any]) -> None:
    for page in pages:
        for first, *rest in named(page):
            assert first in commands, f"{page.name}: there is no skein {first}"
            command = commands[first]
            if rest and rest[0] in getattr(command, "commands", {}):
                command = command.commands[rest[0]]
            for option in (word.partition("=")[0] for word in rest if word.startswith("--")):
                assert option in options_of(command), f"{page.name}: skein {first} has no {option}"


def test_blocks_that_are_not_run_say_why(pages: list[Path], blocks: Callable[[Path], list[Any]]) -> None:
    for page in pages:
        for block in blocks(page):
            if block.mark.startswith("not run"):
                assert re.fullmatch(r"not run: \w.+", block.mark), f"{page.name}: {block.mark}"


def test_every_page_with_commands_to_run_is_followed(
    pages: list[Path], blocks: Callable[[Path], list[Any]], root: Path
) -> None:
    tests = "".join(test.read_text(encoding="utf-8") for test in (root / "tests/docs").glob("test_*.py"))
    for page in pages:
        if any(block.kind == "sh" for block in blocks(page)):
            assert f'follow(root / "{page.relative_to(root)}")' in tests, f"{page.name}: nobody runs its blocks"
