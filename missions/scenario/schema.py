"""The JSON Schema of scenario files, made from the model: for editors, and for the page that explains the keys."""

import ast
import inspect
import textwrap
from itertools import pairwise
from typing import Any

from missions.scenario.degrees import GeodeticPoint
from missions.scenario.keys import Keys
from missions.scenario.model import Scenario

DIALECT = "https://json-schema.org/draft/2020-12/schema"
NOT_ALWAYS = {
    "Scenario": ("vehicles", [{"required": ["vehicles"]}, {"required": ["shape"]}]),
    "RouteModel": ("points", [{"required": ["points"]}, {"required": ["origin", "target"]}]),
}
"""What the model makes for itself before it checks that it is there, by table: the key, and what must be given."""
BY_DEGREES = {"VehicleModel": ("origin", "target"), "RouteModel": ("origin", "target", "points")}
"""Keys with places that may be given by degrees, too, by table;"""
STANDS_AT = ("RadarModel", "ObstacleModel")
"""and tables of what stands at x_m and y_m, or at lat_deg and lon_deg."""


def scenario_schema() -> dict[str, Any]:
    """The schema. What only the program can check, as whether ids are given twice, it does not say."""
    schema: dict[str, Any] = Scenario.model_json_schema()
    models = {model.__name__: model for model in Keys.__subclasses__()}
    tables = {"Scenario": schema, **schema["$defs"]}
    for name, table in tables.items():
        table.pop("title", None)
        table["description"] = inspect.cleandoc(models[name].__doc__ or "")
        for key, text in _docstrings(models[name]).items():
            table["properties"][key]["description"] = text
        for entry in table["properties"].values():
            entry.pop("title", None)
    for name, (key, any_of) in NOT_ALWAYS.items():
        tables[name]["required"].remove(key)
        tables[name]["anyOf"] = any_of
    _allow_degrees(schema["$defs"])
    return {"$schema": DIALECT, "title": "Skein scenario", **schema}


def _allow_degrees(tables: dict[str, Any]) -> None:
    """Let places be given as `missions.scenario.degrees` takes them."""
    point = GeodeticPoint.model_json_schema()
    for table, keys in BY_DEGREES.items():
        for key in keys:
            entry = tables[table]["properties"][key]
            if "items" in entry:
                entry["items"] = {"anyOf": [entry["items"], point]}
            else:
                entry["anyOf"].insert(1, point)
    for table in STANDS_AT:
        properties, required = tables[table]["properties"], tables[table]["required"]
        for metres, degrees in (("x_m", "lat_deg"), ("y_m", "lon_deg")):
            required.remove(metres)
            properties[degrees] = {**point["properties"][degrees], "description": f"In place of `{metres}`."}
        tables[table]["anyOf"] = [{"required": ["x_m", "y_m"]}, {"required": ["lat_deg", "lon_deg"]}]


def _docstrings(model: type[Keys]) -> dict[str, str]:
    """What stands below the keys in the model's source."""
    (definition,) = ast.parse(textwrap.dedent(inspect.getsource(model))).body
    assert isinstance(definition, ast.ClassDef)
    found = {}
    for key, text in pairwise(definition.body):
        if (
            isinstance(key, ast.AnnAssign)
            and isinstance(key.target, ast.Name)
            and isinstance(text, ast.Expr)
            and isinstance(text.value, ast.Constant)
            and isinstance(text.value.value, str)
        ):
            found[key.target.id] = " ".join(text.value.value.split())
    return found
