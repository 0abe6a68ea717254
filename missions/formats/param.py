"""`.param` files: NAME,VALUE a line, as Mission Planner, MAVProxy and QGroundControl's users keep them."""

import math
from collections.abc import Mapping
from pathlib import Path

from missions.errors import InputError
from missions.formats.files import read_text, write_text


def write_param(parameters: Mapping[str, float], path: Path) -> None:
    """Write parameters; `read_param` gives back equal ones. Raises InputError."""
    write_text(path, "".join(f"{name},{value:.9g}\n" for name, value in sorted(parameters.items())))


def read_param(path: Path) -> dict[str, float]:
    """Read parameters; "#" begins a comment, and a comma or white space separates. Raises InputError with the line."""
    parameters: dict[str, float] = {}
    for number, line in enumerate(read_text(path).splitlines(), 1):
        words = line.partition("#")[0].replace(",", " ").split()
        if not words:
            continue
        try:
            name, text = words
            value = float(text)
        except ValueError:
            raise InputError(f"{path}: line {number}: must be NAME,VALUE, got {line!r}") from None
        if not math.isfinite(value):
            raise InputError(f"{path}: line {number}: {name}: must be a number, got {text}")
        parameters[name.upper()] = value
    return parameters
