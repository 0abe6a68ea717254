"""`skein schema`: what a scenario file may hold, for editors and for people."""

from pathlib import Path
from typing import Annotated

import typer

from gcs.cli.errors import exit_codes

FileOption = Annotated[Path | None, typer.Option("--out", metavar="FILE", help="Write it there, not to the screen.")]
MarkdownOption = Annotated[bool, typer.Option("--markdown", help="As a page for people instead: the keys in tables.")]


def schema(out: FileOption = None, markdown: MarkdownOption = False) -> None:
    """Print the JSON Schema of scenario files, for editors.

    With it they complete and check as you type.

    Example: skein schema --out scenario.schema.json
    """
    with exit_codes():
        import json

        from missions.errors import InputError
        from missions.scenario.manual import manual
        from missions.scenario.schema import scenario_schema

        text = manual() if markdown else json.dumps(scenario_schema(), indent=1) + "\n"
        if out is None:
            print(text, end="")
            return
        try:
            out.write_text(text, encoding="utf-8")
        except OSError as error:
            raise InputError(f"{out}: {error.strerror}; name another file with --out") from None
