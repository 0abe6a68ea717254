"""All keys of a scenario file as a page for people, made from its schema."""

import json
from collections.abc import Iterator
from typing import Any

from missions.scenario.schema import scenario_schema

HEAD = """# The scenario file, key by key

A scenario is a TOML file. This page is made from the model that checks it (`skein schema --markdown`). `skein schema`
gives the same as a JSON Schema, with which editors complete and check as you type: keep it beside the scenario
(`skein schema --out scenario.schema.json`), whose first line then is, for Even Better TOML and taplo:

    #:schema ./scenario.schema.json

Lengths in metres, speeds in m/s, angles in degrees, times in seconds, all in a local frame: x east, y north, z up from
`origin`. Keys that are not listed are refused, by name. The scenarios that ship (`missions/scenarios/`) are examples.
"""


def manual() -> str:
    """The page, in Markdown."""
    schema = scenario_schema()
    parts = [HEAD, "## At the top\n", *_table(schema)]
    for path, table in _tables(schema, schema):
        parts += [f"\n## {path}\n", f"{table['description']}\n", *_table(table)]
    return "\n".join(parts) + "\n"


def _tables(schema: dict[str, Any], table: dict[str, Any], path: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """The tables below one, in the file's order, with how each is written there."""
    for key, entry in table["properties"].items():
        for name, many in _references(entry):
            child = schema["$defs"][name]
            here = f"{path}{key}"
            yield (f"[[{here}]]" if many else f"[{here}]"), child
            yield from _tables(schema, child, f"{here}.")


def _references(entry: dict[str, Any]) -> Iterator[tuple[str, bool]]:
    """Names of the tables that a key takes, and whether it takes several."""
    for choice in (entry, *entry.get("anyOf", ())):
        if "$ref" in choice:
            yield choice["$ref"].rsplit("/", 1)[1], False
        elif "$ref" in choice.get("items", {}):
            yield choice["items"]["$ref"].rsplit("/", 1)[1], True


def _table(table: dict[str, Any]) -> list[str]:
    """The plain keys of a table."""
    rows = ["| key | takes | unless given | |", "|---|---|---|---|"]
    for key, entry in table["properties"].items():
        if any(_references(entry)):
            continue
        needed = key in table.get("required", ()) or any(key in one["required"] for one in table.get("anyOf", ())[:1])
        unless = "**needed**" if needed else _default(entry.get("default"))
        rows.append(f"| `{key}` | {_takes(entry)} | {unless} | {entry.get('description', '')} |")
    return rows if len(rows) > 2 else ["Tables only."]


def _default(value: Any) -> str:
    return "-" if value is None or value == "" else f"`{json.dumps(value)}`"


def _takes(entry: dict[str, Any]) -> str:
    """What a key takes, in words."""
    if "anyOf" in entry:
        return " or ".join(_takes(choice) for choice in entry["anyOf"] if choice.get("type") != "null")
    if "enum" in entry:
        return ", ".join(f'`"{value}"`' for value in entry["enum"])
    if "const" in entry:
        return f'`"{entry["const"]}"`'
    if entry.get("type") == "array":
        if "prefixItems" in entry:
            return f"[{', '.join(_takes(item) for item in entry['prefixItems'])}]"
        return f"list of {_takes(entry['items'])}"
    if entry["type"] == "object":
        return f"{{ {', '.join(f'{key} = ...' for key in entry['properties'])} }}"
    words = {"number": "number", "integer": "whole number", "string": "text", "boolean": "`true`, `false`"}
    return words[entry["type"]] + _bounds(entry)


def _bounds(entry: dict[str, Any]) -> str:
    signs = (("exclusiveMinimum", ">"), ("minimum", ">="), ("exclusiveMaximum", "<"), ("maximum", "<="))
    bounds = [f"{sign} {entry[key]:g}" for key, sign in signs if key in entry and abs(entry[key]) < 1e15]
    return " " + ", ".join(bounds) if bounds else ""
