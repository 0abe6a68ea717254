"""Checked access to parsed JSON: errors name the file and the place in it."""

import json
import math
from pathlib import Path
from typing import Any

from missions.errors import InputError
from missions.mission import degrees_to_e7

_LARGEST_E7 = 2**31 - 1


class JsonReader:
    """Checked access to one file.

    Args:
        path: named in errors.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def error(self, key: str, reason: str) -> InputError:
        """The error that says what is wrong at a place."""
        return InputError(f"{self._path}: {key}: {reason}")

    def table(self, value: Any, key: str) -> dict[str, Any]:
        """An object."""
        if not isinstance(value, dict):
            raise self.error(key, f"must be an object, got {_shown(value)}")
        return value

    def array(self, value: Any, key: str) -> list[Any]:
        """An array."""
        if not isinstance(value, list):
            raise self.error(key, f"must be an array, got {_shown(value)}")
        return value

    def whole(self, value: Any, key: str) -> int:
        """A whole number."""
        if not isinstance(value, int) or isinstance(value, bool):
            raise self.error(key, f"must be a whole number, got {_shown(value)}")
        return value

    def numbers(self, value: Any, key: str, count: int) -> list[float]:
        """An array of so many numbers; null is NaN."""
        values = self.array(value, key)
        if len(values) != count:
            raise self.error(key, f"must have {count} numbers, got {len(values)}")
        return [self._number(number, f"{key}[{index}]") for index, number in enumerate(values)]

    def finite(self, value: Any, key: str) -> float:
        """A number that is there."""
        number = self._number(value, key)
        if not math.isfinite(number):
            raise self.error(key, f"must be a number, got {_shown(value)}")
        return number

    def place_e7(self, value: Any, key: str) -> tuple[int, int]:
        """[latitude, longitude] in degrees, in the wire's 1e-7 degrees."""
        latitude, longitude = self.numbers(value, key, 2)
        return self.e7(latitude, f"{key}[0]"), self.e7(longitude, f"{key}[1]")

    def e7(self, degrees: float, key: str) -> int:
        """Degrees in the wire's 1e-7 degrees; 0 for null, which items without a position may have."""
        if math.isnan(degrees):
            return 0
        if not abs(degrees) * 1e7 <= _LARGEST_E7:
            raise self.error(key, f"must be degrees, got {degrees:g}")
        return degrees_to_e7(degrees)

    def _number(self, value: Any, key: str) -> float:
        if value is None:
            return math.nan
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            raise self.error(key, f"must be a number or null, got {_shown(value)}")
        return float(value)


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."
