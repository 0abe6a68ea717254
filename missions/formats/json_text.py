"""JSON read without losing anything: what one of two readers would take otherwise is refused, by its place."""

import json
import math
import re
from pathlib import Path
from typing import Any

from missions.errors import InputError

_STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def parse_json(text: str, path: Path) -> Any:
    """The values in a text; // and /* */ comments, which some stations' readers allow, are left out.

    Args:
        text: the file's.
        path: named in errors.

    Raises:
        InputError: it is no JSON (by its line), a key stands twice in an object, or a number is none that there is
            (by its place).
    """
    try:
        value = json.loads(_STRING_OR_COMMENT.sub(_blank_comment, text), object_pairs_hook=_Table)
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: line {error.lineno}: not JSON: {error.msg}; export the plan again") from error
    except (ValueError, RecursionError) as error:
        what = "nested too deeply" if isinstance(error, RecursionError) else "a number of thousands of digits"
        raise InputError(f"{path}: not a plan: {what}; export it again") from None
    _check(value, path)
    return value


class _Table(dict[str, Any]):
    """An object, and the first key that stood in it twice."""

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        seen: set[str] = set()
        self.twice = next((key for key, _ in pairs if key in seen or seen.add(key)), None)  # type: ignore[func-returns-value]


def _blank_comment(match: re.Match[str]) -> str:
    """A string as it is; a comment as the line ends in it, so that errors name the right line."""
    found = match[0]
    return found if found.startswith('"') else "\n" * found.count("\n") or " "


def _check(value: Any, path: Path) -> None:
    left = [("", value)]
    while left:
        key, one = left.pop()
        if isinstance(one, _Table):
            if one.twice is not None:
                raise InputError(f"{path}: {_inside(key, one.twice)}: stands here twice; leave one of them")
            left += [(_inside(key, name), inner) for name, inner in one.items()]
        elif isinstance(one, list):
            left += [(f"{key}[{index}]", inner) for index, inner in enumerate(one)]
        elif isinstance(one, (int, float)) and not _finite(one):
            raise InputError(f"{path}: {key or 'the file'}: no number that there is; write null for no value")


def _finite(number: float) -> bool:
    try:
        return math.isfinite(number)
    except OverflowError:  # a whole number beyond every float
        return False


def _inside(key: str, name: str) -> str:
    return f"{key}.{name}" if key else name
