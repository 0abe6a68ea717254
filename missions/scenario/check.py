"""What no single key can tell of a scenario: whether its parts fit each other."""

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np

from missions.environment import ground_height_m
from missions.environment.obstacles import wall_distances_m
from missions.scenario.model import Scenario


def problems(scenario: Scenario) -> Iterator[str]:
    """Contradictions between keys, each as "key: what is wrong; what to do"."""
    yield from _vehicles(scenario)
    yield from _network(scenario)
    yield from _places(scenario)


def _vehicles(scenario: Scenario) -> Iterator[str]:
    for key in ("sysid", "name"):
        seen: dict[object, int] = {}
        for i, vehicle in enumerate(scenario.vehicles):
            value = getattr(vehicle, key)
            if value in seen:
                yield f"vehicles[{i}].{key}: {value} is already vehicles[{seen[value]}]'s; give each vehicle its own"
            seen.setdefault(value, i)
    with_slot = [vehicle.slot is not None for vehicle in scenario.vehicles]
    if any(with_slot) and scenario.route is None:
        yield f"vehicles[{with_slot.index(True)}].slot: there is no [route] for it; add one, or give origin and target"
    if any(with_slot) != all(with_slot):
        yield f"vehicles[{with_slot.index(False)}]: has no slot but others have; slots and own targets do not mix"
    if scenario.shape is not None and scenario.route is None:
        yield "shape: there is no [route] for it; add one"
    if scenario.route is not None and not any(with_slot):
        yield "route: no vehicle has a slot on it; remove it, or give the vehicles slots"


def _network(scenario: Scenario) -> Iterator[str]:
    if scenario.formation.reassign:
        if scenario.formation.swarm_clock:
            yield "formation.reassign: places change at times that all know, and a swarm_clock shifts them; choose one"
        if scenario.formation.avoidance:
            yield (
                "formation.reassign: others' intents of before a move would be given way to; leave avoidance out, the "
                "moves themselves are checked for separation"
            )
    known = {vehicle.sysid for vehicle in scenario.vehicles}
    named: list[tuple[str, Sequence[int]]] = []
    if not isinstance(graph := scenario.formation.graph, str):
        named += [(f"formation.graph[{i}]", pair) for i, pair in enumerate(graph)]
    named.append(("formation.pinned", scenario.formation.pinned or ()))
    named += [(f"links[{i}]", (link.sender, link.receiver)) for i, link in enumerate(scenario.links)]
    for i, failure in enumerate(scenario.failures):
        named.append((f"failures[{i}]", failure.vehicles))
        named += [(f"failures[{i}].groups[{j}]", group) for j, group in enumerate(failure.groups)]
        grouped = [sysid for group in failure.groups for sysid in group]
        if len(set(grouped)) < len(grouped):
            yield f"failures[{i}].groups: a vehicle is in two of them; leave it in one"
    for key, sysids in named:
        if missing := sorted(set(sysids) - known):
            yield f"{key}: there is no vehicle {missing[0]}; the sysids are {min(known)} to {max(known)}"
    for key, (one, other) in ((key, pair) for key, pair in named if key.startswith(("formation.graph", "links"))):
        if one == other:
            yield f"{key}: vehicle {one} with itself; name two vehicles"


def _places(scenario: Scenario) -> Iterator[str]:
    if any(vehicle.slot is not None for vehicle in scenario.vehicles) and scenario.route is None:
        return
    area, limits = scenario.environment.area, scenario.limits
    origins, targets = [], []
    for i, vehicle in enumerate(scenario.vehicles):
        origin, target = scenario.origin_m(vehicle), scenario.target_m(vehicle)
        origins.append(origin)
        targets.append(target)
        for key, (x, y, z) in (("origin", origin), ("target", target)):
            here = f"vehicles[{i}].{key}: ({x:.0f}, {y:.0f}, {z:.0f})"
            if not (area.x_min_m <= x <= area.x_max_m and area.y_min_m <= y <= area.y_max_m):
                yield f"{here} lies outside the area; move it or widen area.x_m, area.y_m"
            if z > min(area.z_max_m, limits.altitude_max_m):
                yield f"{here} lies above area.z_m or limits.altitude_max_m"
            for j, obstacle in enumerate(scenario.environment.obstacles):
                margin = limits.obstacle_margin_m
                if wall_distances_m(np.array([x, y, z]), obstacle) < margin:
                    yield f"{here} is within {margin:g} m of obstacles[{j}]; move it or lower limits.obstacle_margin_m"
        ground = ground_height_m(target[0], target[1], scenario.environment.terrain)
        least = ground + limits.clearance_m
        if target[2] < ground:
            yield (
                f"vehicles[{i}].target: {ground - target[2]:.0f} m inside the ground at "
                f"({target[0]:.0f}, {target[1]:.0f}); raise z to at least {math.ceil(least)} m"
            )
        elif target[2] < least:
            yield (
                f"vehicles[{i}].target: {target[2] - ground:.0f} m above the ground, limits.clearance_m is "
                f"{limits.clearance_m:g}; raise z to at least {math.ceil(least)} m"
            )
        if math.dist(origin[:2], target[:2]) < limits.leg_min_m:
            yield f"vehicles[{i}].target: closer to the origin than limits.leg_min_m = {limits.leg_min_m:g}"
    for key, places, together in (("origin", origins, "start"), ("target", targets, "arrive")):
        for i, j in itertools.combinations(range(len(places)), 2):
            if (distance := math.dist(places[i], places[j])) < limits.separation_m:
                named = "slot" if scenario.vehicles[j].slot else key
                yield (
                    f"vehicles[{j}].{named}: {distance:.0f} m from vehicles[{i}]'s, and both {together} together; "
                    f"keep limits.separation_m = {limits.separation_m:g}"
                )
