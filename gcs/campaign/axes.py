"""What varies in a campaign: the arm of the law, and keys of the scenario that a flight depends on but its plan does
not.

In a file an axis is written as the key is in a scenario, with a list of values in place of one:

    arm = ["full", "own_schedule"]
    [formation]
    delay_s = [0.1, 0.2, 0.4]
"""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from operator import attrgetter
from pathlib import Path
from typing import Any, get_args

from pydantic import TypeAdapter, ValidationError
from pydantic_core import to_json

from missions.errors import InputError
from missions.scenario import Scenario
from missions.scenario.check import problems
from sitl.config import Arm

ARM = "arm"
DELAY = "formation.delay_s"
WHOLE_TABLES = ("formation", "channel")
"""Tables of a scenario of which every key may vary."""
KEYS = ("links", "failures", "wind.steady_m_s", "wind.gusts")
"""Others that may."""

LABEL = 16
"""Characters that there is room for."""

Value = Any
"""As the scenario holds it: numbers, words, or tables and tuples of them; to be compared and hashed."""
Axes = Mapping[str, tuple[Value, ...]]
"""By key, such as formation.delay_s, its values: each once, in order."""


def variable_keys(scenario: Scenario) -> list[str]:
    """All keys that may vary."""
    tables = [f"{table}.{key}" for table in WHOLE_TABLES for key in type(getattr(scenario, table)).model_fields]
    return [ARM, *tables, *KEYS]


def make_axes(scenario: Scenario, values: Mapping[str, Sequence[Any]]) -> dict[str, tuple[Value, ...]]:
    """Axes from values as TOML has them, checked as the scenario checks them.

    Raises:
        InputError: a key that may not vary, or a value that the scenario does not take.
    """
    axes: dict[str, tuple[Value, ...]] = {}
    for key, wanted in values.items():
        if key not in (known := variable_keys(scenario)):
            raise InputError(f"{key}: cannot vary with one plan; what can is {', '.join(known)}")
        if not isinstance(wanted, Sequence) or isinstance(wanted, str) or not wanted:
            raise InputError(f"{key}: needs a list of values, got {wanted!r}")
        axes[key] = tuple(dict.fromkeys(_checked(scenario, key, value) for value in wanted))
    return axes


def with_values(scenario: Scenario, values: Mapping[str, Value]) -> Scenario:
    """The scenario with other values of some keys; an arm is no part of it.

    Raises:
        InputError: a value that the scenario does not take.
    """
    for key, value in values.items():
        if key == ARM:
            continue
        table, _, field = key.partition(".")
        old = getattr(scenario, table)
        try:
            if field:
                changed = type(old).model_validate({**dict(old), field: value})
            else:
                annotation: Any = Scenario.model_fields[table].annotation
                changed = TypeAdapter(annotation).validate_python(value)
        except ValidationError as error:
            raise InputError(f"{key}: {error.errors()[0]['msg']}, got {value!r}") from None
        scenario = scenario.model_copy(update={table: changed})
    return scenario


def cell_of(value: Value) -> str:
    """A value as text: a word or a number as it is, anything else as JSON."""
    return str(value) if isinstance(value, str | float) else to_json(value, exclude_none=True).decode()


def labels(values: Sequence[Value]) -> dict[str, str]:
    """By the text of each value of an axis, what to call it where there is little room: #1, #2 for what is long."""
    texts = [cell_of(value) for value in values]
    return {text: text if len(text) <= LABEL else f"#{i}" for i, text in enumerate(texts, 1)}


def _checked(scenario: Scenario, key: str, value: Any) -> Value:
    """A value as the scenario holds it."""
    if key == ARM:
        if value not in get_args(Arm):
            raise InputError(f"{key}: must be one of {', '.join(get_args(Arm))}, got {value!r}")
        return str(value)
    changed = with_values(scenario, {key: value})
    for problem in problems(changed):
        raise InputError(f"{key}: {value!r}: {problem}")
    return attrgetter(key)(changed)


def read_axes(path: Path) -> dict[str, Any]:
    """Lists of values by key from a campaign's file, as TOML has them.

    Raises:
        InputError: the file cannot be read or is not TOML.
    """
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise InputError(f"{path}: {reason}") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path}: not TOML: {error}") from None
    return dict(_flat(data))


def parse_axis(text: str) -> tuple[str, list[Any]]:
    """KEY=VALUE,VALUE of a command line; values as in TOML, but that words need no quotes.

    Raises:
        InputError: there is no key or no value.
    """
    key, equals, values = text.partition("=")
    if not equals or not key or not values:
        raise InputError(f"--vary {text}: must be KEY=VALUE,VALUE such as formation.delay_s=0.1,0.2")
    try:
        return key, tomllib.loads(f"values = [{values}]")["values"]
    except tomllib.TOMLDecodeError:
        return key, values.split(",")


def _flat(table: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Keys of tables in tables with dots."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{above}{key}.")
        else:
            yield above + key, value
