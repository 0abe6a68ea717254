"""Where commands write: tables for people, or JSON alone, on standard output; progress on standard error."""

import json
from typing import Any

from rich.console import Console
from rich.table import Table

WIDE = 100

out = Console(highlight=False)
progress = Console(stderr=True, highlight=False)


def print_wide(table: Table) -> None:
    """A table that needs up to `WIDE` columns; a file or a pipe takes them."""
    wide = out if out.is_terminal else Console(highlight=False, width=WIDE)
    wide.print(table)


def print_json(values: Any) -> None:
    """JSON on standard output, without NaN."""
    print(json.dumps(values, indent=1, allow_nan=False))


def print_json_line(values: Any) -> None:
    """The same on a single line, for what is too long to read, or is read while the command goes on."""
    print(json.dumps(values, allow_nan=False), flush=True)
