"""Reading scenarios: by name from those that ship, or from a TOML file."""

import difflib
import logging
import tomllib
from importlib import resources
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from missions.errors import InputError
from missions.scenario.check import problems
from missions.scenario.model import Files, Scenario

_log = logging.getLogger(__name__)

SHOWN = 5
"""Problems of a scenario that are told at once."""
_REASONS = {
    "missing": "is missing",
    "greater_than": "must be > {gt:g}",
    "greater_than_equal": "must be >= {ge:g}",
    "less_than": "must be < {lt:g}",
    "less_than_equal": "must be <= {le:g}",
    "float_type": "must be a number",
    "int_type": "must be a whole number",
    "bool_type": "must be true or false",
    "finite_number": "must be a finite number",
    "string_type": "must be text",
    "string_pattern_mismatch": "must be letters, digits, - and _ only",
    "literal_error": "must be one of {expected}",
    "too_short": "needs at least {min_length} entries",
    "too_long": "takes at most {max_length} entries",
    "tuple_type": "must be a list",
    "model_type": "must be a table",
}


def shipped_scenarios() -> list[str]:
    """Names of the scenarios that ship."""
    folder = resources.files("missions") / "scenarios"
    return sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))


def load_scenario(name_or_file: str) -> Scenario:
    """A shipped scenario by its name, or one from a file.

    Raises:
        InputError: no such scenario, or it cannot be used; the message names file, key and reason.
    """
    text, label = read_scenario_text(name_or_file)
    return parse_scenario(text, label, scenario_folder(name_or_file))


def scenario_folder(name_or_file: str) -> Path:
    """The folder that a scenario's raster is looked for in: that of its file."""
    return Path() if name_or_file in shipped_scenarios() else Path(name_or_file).parent


def read_scenario_text(name_or_file: str) -> tuple[str, str]:
    """The TOML text of a scenario and the file name to call it by in errors."""
    if name_or_file in shipped_scenarios():
        label = f"{name_or_file}.toml"
        return (resources.files("missions") / "scenarios" / label).read_text(encoding="utf-8"), label
    path = Path(name_or_file)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{path}: not UTF-8 text; a scenario is a TOML file") from None
    except FileNotFoundError:
        shipped = ", ".join(shipped_scenarios())
        raise InputError(f"{path}: no such file, nor a scenario that ships ({shipped})") from None
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    _log.info("%s: read", path)
    return text, path.name


def parse_scenario(text: str, label: str, folder: Path = Path(), raster: Path | None = None) -> Scenario:
    """Check a scenario's TOML text, and read the raster that it names.

    Args:
        text: the file's content.
        label: what to call the file in errors.
        folder: which the raster's path counts from.
        raster: an absolute path or one from `folder`, read in place of the one that the scenario names.

    Raises:
        InputError: with the first problems, and how many more there are.
    """
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{label}: not TOML: {error}") from None
    try:
        scenario = Scenario.model_validate(data, context=Files(folder=folder, raster=raster))
    except ValidationError as error:
        # What is unknown first: it is often why something else is missing.
        details = sorted(error.errors(), key=lambda detail: detail["type"] != "extra_forbidden")
        raise InputError(_told(label, [_describe(detail) for detail in details])) from None
    if found := list(problems(scenario)):
        raise InputError(_told(label, found))
    return scenario


def _told(label: str, reasons: list[str]) -> str:
    """The problems in one line; no more of them than people mend at once."""
    more = f" (and {len(reasons) - SHOWN} more)" if len(reasons) > SHOWN else ""
    return f"{label}: {'; '.join(reasons[:SHOWN])}{more}"


def _describe(detail: ErrorDetails) -> str:
    """One of pydantic's errors as "radars[1].radius_m: must be > 0, got -1500"."""
    key = _key(detail["loc"])
    if detail["type"] == "extra_forbidden":
        return f"{key}: unknown key{_suggestion(detail['loc'])}"
    if detail["type"] == "value_error":
        reason = detail["msg"].removeprefix("Value error, ")
        return f"{key}: {reason}" if key else reason
    context: dict[str, Any] = detail.get("ctx", {})
    reason = _REASONS.get(detail["type"], detail["msg"]).format(**context)
    return f"{key}: {reason}" if detail["type"] == "missing" else f"{key}: {reason}, got {_shown(detail['input'])}"


def _key(loc: tuple[int | str, ...]) -> str:
    """("radars", 1, "radius_m") as "radars[1].radius_m"."""
    key = ""
    for part in loc:
        key += f"[{part}]" if isinstance(part, int) else f".{part}" if key else part
    return key


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _suggestion(loc: tuple[int | str, ...]) -> str:
    """The known key nearest to an unknown one."""
    model: Any = Scenario
    for part in loc[:-1]:
        if isinstance(part, str):
            model = _model_in(model.model_fields[part].annotation)
    near = difflib.get_close_matches(str(loc[-1]), model.model_fields, n=1)
    return f"; did you mean {near[0]}?" if near else f"; known are {', '.join(model.model_fields)}"


def _model_in(annotation: Any) -> Any:
    """The table's model inside `X`, `X | None` or `tuple[X, ...]`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next(model for argument in get_args(annotation) if (model := _model_in(argument)) is not None)
