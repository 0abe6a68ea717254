"""Commands that are imported when they are used: help comes at once, and each command loads its own file alone."""

from importlib import import_module
from typing import Any, NamedTuple

import typer
from typer.core import TyperCommand, TyperGroup

from gcs.cli.verbosity import Commands


class Entry(NamedTuple):
    """Where a command is, and the first sentence of its help.

    Attributes:
        place: "file:name" in `gcs.cli`; of a function, or of Commands for a group.
        summary: what the list of commands says.
    """

    place: str
    summary: str


class LaterCommand(TyperCommand):
    """A command that has its name and its first sentence, and becomes the real one when there is a use for it."""

    def __init__(self, name: str, entry: Entry) -> None:
        super().__init__(name, help=entry.summary, rich_markup_mode=None)
        self._place = entry.place

    def make_context(self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any) -> Any:
        """The context of the real command."""
        return self._load().make_context(info_name, args, parent, **extra)

    def _load(self) -> Any:
        file, _, name = self._place.partition(":")
        found = getattr(import_module(f"gcs.cli.{file}"), name)
        if isinstance(found, Commands):
            return typer.main.get_group(found)
        alone = Commands()
        alone.command(self.name)(found)
        return typer.main.get_command(alone)


class LaterGroup(TyperGroup):
    """A group whose commands are listed in `entries`."""

    entries: dict[str, Entry]

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        for name, entry in self.entries.items():
            self.add_command(LaterCommand(name, entry))
