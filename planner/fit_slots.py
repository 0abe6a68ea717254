"""A formation made to fit its route: narrowed where ground, walls, sides or turns leave no room for all of it, passing
one after the other where narrowing brings aircraft too near to each other, and opened again behind."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.reference import Reference, build_reference
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario
from planner.checks import RADIUS_TOLERANCE, TOLERANCE_M, place
from planner.limits import airspeed_range_m_s, flyable
from planner.loiter import Circle
from planner.proof.separation import separations
from planner.proof.surroundings import surroundings
from planner.proof.tracks import Tracks
from planner.schedule import Schedule, leg_faults
from planner.slots import SINGLE_FILE, SlotFit, full_width, slot_path_m, slot_schedule
from planner.write_mission import write_mission

FloatArray = npt.NDArray[np.float64]

SCALE_STEP = 1.0 / 16.0


@dataclass(frozen=True)
class FittedSlots:
    """Paths (m, 3) and schedules of all slots, and how the formation fits its route."""

    fit: SlotFit
    paths_m: tuple[FloatArray, ...]
    schedules: tuple[Schedule, ...]


class Misfit(NamedTuple):
    """What is wrong with a formation on its route.

    Attributes:
        corners: of the route, at which a change may help.
        near: whether aircraft come too near to each other, so that narrowing is no help.
        text: slot and reason.
    """

    corners: tuple[int, ...]
    near: bool
    text: str


def fit_slots(scenario: Scenario, route_m: FloatArray) -> FittedSlots:
    """Find, corner by corner, the widest the formation can be.

    Starts at full width. What does not fit narrows the corners beside it by `SCALE_STEP`; who comes too near to
    another has them staggered, then flown in single file, until all fits. Then each corner is opened again as far as
    it goes.

    Raises:
        InputError: at no width does it fit; names corner, slot and reason.
    """
    fit = full_width(route_m)
    slots, misfits = _laid_out(scenario, fit)
    causes = misfits
    while misfits:
        changed = fit
        for misfit in misfits:
            changed = _changed(changed, misfit, fit)
        if changed is fit:
            at = ", ".join(f"route.points[{corner}]" for corner in causes[0].corners)
            then = "" if misfits[0].text == causes[0].text else f", and narrowed or staggered {misfits[0].text}"
            raise InputError(
                f"{scenario.name}: {at}: {causes[0].text}{then}; no narrower formation helps: give the route more "
                "room, or the slots other spacings"
            )
        fit = changed
        slots, misfits = _laid_out(scenario, fit)
    for corner in np.flatnonzero(fit.scale < 1.0):
        while fit.scale[corner] < 1.0:
            wider = replace(fit, scale=fit.scale.copy())
            wider.scale[corner] += SCALE_STEP
            tried, misfits = _laid_out(scenario, wider)
            if misfits:
                break
            fit, slots = wider, tried
    return slots


def _changed(fit: SlotFit, misfit: Misfit, before: SlotFit) -> SlotFit:
    """Narrowed or staggered at the misfit's corners, at most one step from `before`; the same where nothing can be."""
    inner = [corner for corner in misfit.corners if 0 < corner < len(fit.scale) - 1]
    if misfit.near:
        if all(before.stagger[corner] == SINGLE_FILE for corner in inner):
            return fit
        stagger = fit.stagger.copy()
        stagger[inner] = np.minimum(before.stagger[inner] + 1, SINGLE_FILE)
        return replace(fit, stagger=stagger)
    if all(before.scale[corner] <= 0.0 for corner in inner):
        return fit
    scale = fit.scale.copy()
    scale[inner] = np.maximum(before.scale[inner] - SCALE_STEP, 0.0)
    return replace(fit, scale=scale)


def _laid_out(scenario: Scenario, fit: SlotFit) -> tuple[FittedSlots, list[Misfit]]:
    """Paths and schedules, and what is wrong with them: first each by itself, then in their surroundings."""
    paths, schedules, misfits = [], [], []
    for vehicle in scenario.vehicles:
        path = slot_path_m(scenario, vehicle, fit)
        try:
            schedule = slot_schedule(scenario, vehicle, path, fit)
        except InputError as error:
            misfits.append(Misfit(tuple(range(1, len(fit.scale) - 1)) or (0, 1), False, str(error)))
            continue
        paths.append(path)
        schedules.append(schedule)
        misfits += _alone(scenario, vehicle.name, path, schedule, fit)
    slots = FittedSlots(fit, tuple(paths), tuple(schedules))
    return slots, misfits or _together(scenario, slots)


def _alone(scenario: Scenario, name: str, path_m: FloatArray, schedule: Schedule, fit: SlotFit) -> list[Misfit]:
    """Legs too short, too long or too fast, and corners too sharp or without room for their arcs."""
    limits, airframe, airspeeds = scenario.limits, scenario.airframe.airframe(), airspeed_range_m_s(scenario)
    legs = np.diff(path_m, axis=0)
    across, lengths = np.hypot(legs[:, 0], legs[:, 1]), np.linalg.norm(legs, axis=1)
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    turns = np.abs((np.diff(headings) + np.pi) % (2 * np.pi) - np.pi)
    needed = np.concatenate([[0.0], fillet_radius_m(float(schedule.ground_m_s.max())) * np.tan(turns / 2), [0.0]])
    found = []
    for k in range(len(legs)):
        if not limits.leg_min_m <= lengths[k] <= limits.leg_max_m:
            found.append(Misfit((k, k + 1), False, f"{name}: leg {k + 1} is {lengths[k]:.0f} m long"))
        elif not flyable(
            float(schedule.air_m_s[k]), float(schedule.ground_m_s[k] * schedule.slopes[k]), *airspeeds, airframe
        ):
            text = next(fault for fault in leg_faults(schedule, scenario) if fault.startswith(f"leg {k + 1}:"))
            found.append(Misfit((k, k + 1), False, f"{name}: {text}"))
        room = across[k] if k in (0, len(legs) - 1) else across[k] / 2
        for corner in (k, k + 1):
            if needed[corner] * (1 - RADIUS_TOLERANCE / 2) > room:
                found.append(Misfit(_widest(fit, corner), False, f"{name}: no room for its arc at leg {k + 1}"))
    for k in np.flatnonzero(turns > np.radians(limits.turn_max_deg)).tolist():
        found.append(Misfit(_widest(fit, k + 1), False, f"{name}: turns by {np.degrees(turns[k]):.1f} deg"))
    return found


def _widest(fit: SlotFit, corner: int) -> tuple[int, ...]:
    """Of a corner and its neighbours the widest ones: where scales differ, it is they that bend the path."""
    near = range(max(corner - 1, 1), min(corner + 2, len(fit.scale) - 1))
    widest = max((float(fit.scale[k]) for k in near), default=1.0)
    return tuple(k for k in near if fit.scale[k] == widest) or (corner,)


def _together(scenario: Scenario, slots: FittedSlots) -> list[Misfit]:
    """Paths too near to ground, walls or sides, and slots too near to each other."""
    references = _references(scenario, slots)
    tracks = Tracks(references)
    around = surroundings(tracks, references, scenario)
    names, limits = [vehicle.name for vehicle in scenario.vehicles], scenario.limits
    found = []
    for least, wanted, what in (
        (around.ground.on_ground, 0.0, "too near to the ground"),
        (around.ground.spare, 0.0, "too near to the ground"),
        (around.walls, limits.obstacle_margin_m, "too near to an obstacle"),
        (around.room, 0.0, "outside the area"),
    ):
        for row in np.flatnonzero(least.low < wanted - TOLERANCE_M).tolist():
            s_m = float(least.at[row])
            corners = _nearest(references[row].path.corner_s_m, s_m, slots.fit)
            text = f"{names[row]}: {what} at {place(references[row].points(np.array(s_m)))}"
            found.append(Misfit(corners, False, text))
    apart = separations(tracks, limits.separation_m)
    for k in np.flatnonzero(apart.of_pair.low < limits.separation_m - TOLERANCE_M).tolist():
        first, second = apart.pairs[k].tolist()
        leg = int(np.searchsorted(references[second].corner_time_s, apart.of_pair.at[k])) - 1
        leg = min(max(leg, 0), len(slots.fit.scale) - 2)
        text = f"{names[second]}: {apart.of_pair.value[k]:.0f} m from {names[first]}"
        found.append(Misfit((leg, leg + 1), True, text))
    return found


def _nearest(corner_s_m: FloatArray, s_m: float, fit: SlotFit) -> tuple[int, ...]:
    """The corner next to an arc length, or the other one of the leg where that cannot be narrowed any more."""
    leg = min(max(int(np.searchsorted(corner_s_m, s_m)) - 1, 0), len(fit.scale) - 2)
    both = sorted((leg, leg + 1), key=lambda corner: abs(float(corner_s_m[corner]) - s_m))
    narrower = [corner for corner in both if 0 < corner < len(fit.scale) - 1 and fit.scale[corner] > 0.0]
    return tuple(narrower[:1]) or (leg, leg + 1)


def _references(scenario: Scenario, slots: FittedSlots) -> Sequence[Reference]:
    """What the missions of the slots will lead to."""
    airframe, forecast = scenario.airframe.airframe(), scenario.wind.forecast_m_s
    references = []
    for path, schedule in zip(slots.paths_m, slots.schedules, strict=True):
        x, y, z = path[-1].tolist()
        end = Circle(x, y, z, fillet_radius_m(float(schedule.ground_m_s.max())))
        mission = write_mission(path, schedule, end, scenario.frame)
        references.append(build_reference(mission, scenario.frame, airframe, forecast))
    return references
