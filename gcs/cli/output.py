"""Where commands write: tables for people, or JSON alone, on standard output; progress on standard error."""

import json
from typing import Any

from rich.console import Console

out = Console(highlight=False)
progress = Console(stderr=True, highlight=False)


def print_json(values: Any) -> None:
    """JSON on standard output, without NaN."""
    print(json.dumps(values, indent=1, allow_nan=False))
