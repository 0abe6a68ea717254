"""Checked access to parsed JSON: errors name the file and the place in it."""

import json
import math
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

from missions.commands import Frame
from missions.errors import InputError
from missions.formats.wire import param_on_wire, position_on_wire

Note = Callable[[str], None]
"""Takes a line about what was read otherwise than it stands in a file, or left out."""


def unheard(_: str) -> None:
    """A note that nobody wants."""


class JsonReader:
    """Checked access to one file.

    Args:
        path: named in errors.
        note: takes what is worth saying but no error.
    """

    def __init__(self, path: Path, note: Note = unheard) -> None:
        self._path = path
        self._note = note

    def error(self, key: str, reason: str) -> InputError:
        """The error that says what is wrong at a place."""
        return InputError(f"{self._path}: {key}: {reason}")

    def note(self, key: str, text: str) -> None:
        """Say something about a place."""
        self._note(f"{key}: {text}")

    def table(self, value: Any, key: str, known: Collection[str] = ()) -> dict[str, Any]:
        """An object; with `known`, other keys than these are noted."""
        if not isinstance(value, dict):
            raise self.error(key, f"must be an object, got {_shown(value)}")
        for name in value:
            if known and name not in known:
                self.note(key, f"{_shown(name)} is not known here and was not read")
        return value

    def array(self, value: Any, key: str) -> list[Any]:
        """An array."""
        if not isinstance(value, list):
            raise self.error(key, f"must be an array, got {_shown(value)}")
        return value

    def whole(self, value: Any, key: str, largest: int = 2**31 - 1) -> int:
        """A whole number from 0, however it is written."""
        if not isinstance(value, (int, float)) or isinstance(value, bool) or value != int(value):
            raise self.error(key, f"must be a whole number, got {_shown(value)}")
        if not 0 <= value <= largest:
            raise self.error(key, f"must be 0 to {largest}, got {_shown(value)}")
        return int(value)

    def numbers(self, value: Any, key: str, count: int) -> list[float]:
        """An array of so many numbers; null is NaN."""
        values = self.array(value, key)
        if len(values) != count:
            raise self.error(key, f"must have {count} numbers, got {len(values)}")
        return [self.number(number, f"{key}[{index}]") for index, number in enumerate(values)]

    def number(self, value: Any, key: str) -> float:
        """A number that a MAVLink parameter can hold; null is NaN."""
        if value is None:
            return math.nan
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            raise self.error(key, f"must be a number or null, got {_shown(value)}")
        try:
            return param_on_wire(float(value))
        except ValueError as error:
            raise self.error(key, str(error)) from None

    def finite(self, value: Any, key: str) -> float:
        """A number that is there."""
        number = self.number(value, key)
        if not math.isfinite(number):
            raise self.error(key, f"must be a number, got {_shown(value)}")
        return number

    def place_e7(self, value: Any, key: str) -> tuple[int, int]:
        """[latitude, longitude] in degrees, in the wire's 1e-7 degrees."""
        latitude, longitude = self.numbers(value, key, 2)
        return self.position(latitude, f"{key}[0]"), self.position(longitude, f"{key}[1]")

    def position(self, value: float, key: str, frame: int = Frame.GLOBAL) -> int:
        """Param5 or param6 as the wire has it; 0 for null, which items without a position may have."""
        if math.isnan(value):
            return 0
        try:
            return position_on_wire(value, frame)
        except ValueError as error:
            raise self.error(key, str(error)) from None


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."
