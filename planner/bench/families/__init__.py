"""Families of generated problems, each a file: from a random generator, waypoints and a level to a draft."""

from collections.abc import Callable

import numpy as np

from planner.bench.draft import Draft
from planner.bench.families.canyons import canyons
from planner.bench.families.corridors import corridors
from planner.bench.families.cylinders import cylinders
from planner.bench.families.forest import forest
from planner.bench.families.walls import walls

Family = Callable[[np.random.Generator, int, int], Draft]

FAMILIES: dict[str, Family] = {
    "cylinders": cylinders,
    "canyons": canyons,
    "walls": walls,
    "corridors": corridors,
    "forest": forest,
}

__all__ = ["FAMILIES", "Family"]
