"""The reference that a vehicle follows: a filleted path, its altitude and its schedule, built from a mission as the
wire carries it (MODEL, section 6). Planner, endpoint and reports build it by the same function."""

from missions.reference.path import FilletedPath, fillet
from missions.reference.reference import Reference, ReferenceTables, build_reference
from missions.reference.splice import spliced
from missions.reference.wind_triangle import airspeed_on_track, ground_speed_on_track

__all__ = [
    "FilletedPath",
    "Reference",
    "ReferenceTables",
    "airspeed_on_track",
    "build_reference",
    "fillet",
    "ground_speed_on_track",
    "spliced",
]
