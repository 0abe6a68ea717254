"""The verifier's single checks of one UAV's filleted path. Each gives the figure and a list of what is wrong: one line
that says where and by how much.

What may hide between samples (ground, walls, sides, speeds) comes proven from `planner.proof`; what remains is exact:
corners, legs, arcs, and altitudes, whose extremes lie at the ends of quadratic pieces.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.airframe import GRAVITY_M_S2, lift_max_n
from missions.environment.obstacles import wall_distances_m
from missions.mission import Mission
from missions.reference import Reference, airspeed_on_track
from missions.reference.reference import FILLET_BANK, fillet_radius_m
from missions.scenario import Scenario, VehicleModel
from planner.limits import POWER_SHARE, airspeed_range_m_s, power_share
from planner.proof.flight import SpareSpeeds
from planner.proof.surroundings import Surroundings

FloatArray = npt.NDArray[np.float64]

END_TOLERANCE_M = 1.0
"""Between a mission's ends and the scenario's origin and target."""
TOLERANCE_M = 0.05
"""The wire's own resolution: 1.1 cm of latitude and longitude, and what that does to the ground below; and what a
proven bound may lie below the truth (`planner.proof.bracket`)."""
TOLERANCE = 1e-3
"""The same for speeds and angles, relative."""
RADIUS_TOLERANCE = 0.01
"""Fillets are fit for ground speeds before the fillets shorten the legs."""


@dataclass(frozen=True)
class Flown:
    """One UAV's path: its reference, its corners (m, 3) as the wire carries them, its row in what is proven of all."""

    reference: Reference
    corners_m: FloatArray
    row: int


def flown(mission: Mission, reference: Reference, row: int, scenario: Scenario) -> Flown:
    """What a mission's reference flies."""
    frame = scenario.frame
    items = [mission[seq] for seq in reference.corner_seq]
    corners = [(*frame.from_e7(item.lat_e7, item.lon_e7), item.alt_m - frame.alt_m) for item in items]
    return Flown(reference, np.array(corners), row)


def place(point_m: FloatArray) -> str:
    """A point for a message."""
    return f"({point_m[0]:.0f}, {point_m[1]:.0f}, {point_m[2]:.0f})"


def clearance(path: Flown, around: Surroundings, scenario: Scenario) -> tuple[float, list[str]]:
    """Least height above ground once airborne; what is wanted grows from 0 over limits.climb_out_m."""
    row, limits, ground = path.row, scenario.limits, around.ground
    faults = []
    for least in (ground.on_ground, ground.spare):
        if least.low[row] < -TOLERANCE_M:
            s_m = float(least.at[row])
            ramp = limits.clearance_m * min(1.0, s_m / limits.climb_out_m)
            wanted = ramp if least is ground.spare else 0.0
            faults.append(
                f"{wanted + least.value[row]:.0f} m above ground at {place(path.reference.points(np.array(s_m)))}, "
                f"{-least.value[row]:.1f} m less than limits.clearance_m asks for"
            )
    airborne = ground.in_flight if ground.airborne_m[row] < path.reference.length_m else ground.on_ground
    return float(airborne.low[row]), faults


def walls(path: Flown, around: Surroundings, scenario: Scenario) -> tuple[float, list[str]]:
    """Least distance from any obstacle's wall; infinite without obstacles."""
    least, wanted, faults = around.walls, scenario.limits.obstacle_margin_m, []
    if least.low[path.row] < wanted - TOLERANCE_M:
        here = path.reference.points(least.at[path.row])
        distances = [float(wall_distances_m(here, obstacle)) for obstacle in scenario.environment.obstacles]
        faults.append(
            f"{min(distances):.0f} m from obstacles[{distances.index(min(distances))}] at {place(here)}, "
            f"limits.obstacle_margin_m is {wanted:g}"
        )
    return float(least.low[path.row]), faults


def turns(path: Flown, turn_max_deg: float) -> tuple[float, list[str]]:
    """Largest turn at a corner."""
    legs = np.diff(path.corners_m[:, :2], axis=0)
    cross = legs[:-1, 0] * legs[1:, 1] - legs[:-1, 1] * legs[1:, 0]
    turned = np.abs(np.degrees(np.arctan2(cross, np.sum(legs[:-1] * legs[1:], axis=1))))
    faults = [
        f"turns by {turned[k]:.1f} deg at {place(path.corners_m[k + 1])}, limits.turn_max_deg is {turn_max_deg:g}"
        for k in np.flatnonzero(turned > turn_max_deg * (1 + TOLERANCE))
    ]
    return float(turned.max(initial=0.0)), faults


def climbs(path: Flown, climb_max_deg: float) -> tuple[float, float, list[str]]:
    """Steepest climb and steepest descent, both positive: where a quadratic piece of the altitude begins or ends."""
    reference = path.reference
    inside = np.clip(reference.altitude[:, 0], 0.0, reference.length_m)
    s_m = np.unique(np.concatenate([inside, [0.0, reference.length_m]]))
    angles = np.degrees(np.arctan(reference.slopes(s_m)))
    faults = []
    for k in {int(np.argmax(angles)), int(np.argmin(angles))}:
        if abs(angles[k]) > climb_max_deg * (1 + TOLERANCE):
            where = place(reference.points(s_m[k]))
            faults.append(f"climbs at {angles[k]:.1f} deg at {where}, limits.climb_max_deg is {climb_max_deg:g}")
    return max(0.0, float(angles.max())), max(0.0, -float(angles.min())), faults


def legs(path: Flown, leg_min_m: float, leg_max_m: float) -> tuple[float, float, list[str]]:
    """Shortest and longest leg between corners."""
    lengths = np.linalg.norm(np.diff(path.corners_m, axis=0), axis=1)
    faults = [
        f"leg {k + 1} from {place(path.corners_m[k])} is {length:.0f} m long, limits.leg_min_m and leg_max_m are "
        f"{leg_min_m:g} and {leg_max_m:g}"
        for k, length in enumerate(lengths)
        if not leg_min_m - TOLERANCE_M <= length <= leg_max_m + TOLERANCE_M
    ]
    return float(lengths.min()), float(lengths.max()), faults


def speeds(path: Flown, scenario: Scenario) -> tuple[float, float, float, list[str]]:
    """Least and largest airspeed of a leg in the forecast wind, and the largest part of the power that one takes."""
    airframe, wind = scenario.airframe.airframe(), scenario.wind.forecast_m_s
    slowest, fastest = airspeed_range_m_s(scenario)
    airspeeds, shares, faults = [], [], []
    reference = path.reference
    for k, leg in enumerate(np.diff(path.corners_m, axis=0)):
        ground, slope = float(reference.leg_ground_speed_m_s[k]), float(reference.leg_slope[k])
        airspeed = airspeed_on_track(ground, slope, math.atan2(leg[1], leg[0]), wind)
        climb_m_s = ground * slope
        share = power_share(airspeed, climb_m_s / airspeed, airframe)
        airspeeds.append(airspeed)
        shares.append(share)
        where = f"on leg {k + 1} from {place(path.corners_m[k])}"
        if not slowest * (1 - TOLERANCE) <= airspeed <= fastest * (1 + TOLERANCE):
            faults.append(f"airspeed {airspeed:.1f} m/s {where}, planned airspeeds lie in {slowest:g} to {fastest:g}")
        if share > POWER_SHARE + TOLERANCE:
            faults.append(f"takes {share:.0%} of the power there is {where}, {POWER_SHARE:.0%} may be planned")
        if not airframe.climb_rate_min_m_s - TOLERANCE <= climb_m_s <= airframe.climb_rate_max_m_s + TOLERANCE:
            faults.append(f"climbs at {climb_m_s:.1f} m/s {where}, outside the airframe's climb rates")
    return min(airspeeds), max(airspeeds), max(shares), faults


def instants(path: Flown, spare: SpareSpeeds, scenario: Scenario) -> list[str]:
    """Where airspeed or climb rate leave the airframe's limits at any moment, in turns and between legs, too."""
    airframe, faults = scenario.airframe, []
    for least, what, limit in (
        (spare.slow, "airspeed", airframe.airspeed_min_m_s),
        (spare.fast, "airspeed", airframe.airspeed_max_m_s),
        (spare.descent, "climb rate", airframe.climb_rate_min_m_s),
        (spare.climb, "climb rate", airframe.climb_rate_max_m_s),
    ):
        if least.low[path.row] < -TOLERANCE_M:
            t_s = float(least.at[path.row])
            faults.append(
                f"{what} {-least.value[path.row]:.1f} m/s beyond the airframe's {limit:g} after {t_s:.0f} s at "
                f"{place(path.reference.positions(np.array(t_s)))}"
            )
    return faults


def box(path: Flown, around: Surroundings, scenario: Scenario) -> tuple[float, list[str]]:
    """Highest altitude of path and loiter; the area (1) holds on all sides of the path."""
    reference, room = path.reference, around.room
    top = min(scenario.environment.area.z_max_m, scenario.limits.altitude_max_m)
    faults = []
    if room.low[path.row] < -TOLERANCE_M:
        where = place(reference.points(room.at[path.row]))
        faults.append(f"{-room.value[path.row]:.0f} m outside the area or above the highest altitude at {where}")
    if reference.loiter_z_m > top + TOLERANCE_M:
        faults.append(f"loiters at {reference.loiter_z_m:.0f} m, above the highest altitude, {top:.0f} m")
    return max(_highest_m(reference), reference.loiter_z_m), faults


def ends(mission: Mission, reference: Reference, vehicle: VehicleModel, scenario: Scenario) -> list[str]:
    """Whether a mission leads from the scenario's origin to its target."""
    home = mission.home
    start = (*scenario.frame.from_e7(home.lat_e7, home.lon_e7), home.alt_m - scenario.frame.alt_m)
    pairs = (("starts", start, scenario.origin_m(vehicle)), ("ends", reference.target_m, scenario.target_m(vehicle)))
    return [
        f"{verb} at {place(np.array(here))}, {distance:.0f} m from where the scenario has it"
        for verb, here, wanted in pairs
        if (distance := math.dist(here, wanted)) > END_TOLERANCE_M
    ]


def loiter(path: Flown, around: Surroundings, scenario: Scenario) -> list[str]:
    """Whether the circle at the end keeps clear of ground and walls and inside the area."""
    reference = path.reference
    x, y, _ = reference.target_m
    radius, z = abs(reference.loiter_radius_m), reference.loiter_z_m
    limits, area, faults = scenario.limits, scenario.environment.area, []
    ground = around.loiters
    if ground.low[path.row] < limits.clearance_m - TOLERANCE_M:
        faults.append(
            f"loiters {ground.value[path.row]:.0f} m above ground, limits.clearance_m is {limits.clearance_m:g}"
        )
    for i, obstacle in enumerate(scenario.environment.obstacles):
        beside = abs(math.hypot(obstacle.x_m - x, obstacle.y_m - y) - radius) - obstacle.radius_m
        distance = math.hypot(max(beside, 0.0), max(z - obstacle.top_m, 0.0))
        if distance < limits.obstacle_margin_m - TOLERANCE_M:
            faults.append(f"loiters {distance:.0f} m from obstacles[{i}], not {limits.obstacle_margin_m:g}")
    if min(x - area.x_min_m, area.x_max_m - x, y - area.y_min_m, area.y_max_m - y) < radius:
        faults.append(
            f"loiters at {place(np.array([x, y, z]))} with a radius of {radius:.0f} m, partly outside the area"
        )
    return faults


def fillets(path: Flown) -> list[str]:
    """Corners whose arc found no room for the radius that the fastest leg asks for."""
    wanted = fillet_radius_m(float(path.reference.leg_ground_speed_m_s.max()))
    radii = path.reference.path.corner_radius_m
    return [
        f"only room for a radius of {radii[k]:.0f} m at {place(path.corners_m[k])}, {wanted:.0f} m are flown"
        for k in np.flatnonzero(radii < wanted * (1 - RADIUS_TOLERANCE))
    ]


def banks(path: Flown, fastest_m_s: FloatArray, scenario: Scenario) -> tuple[float, list[str]]:
    """Steepest bank of an arc, at the fastest that the schedule is on it.

    Planned banks stay at those that fillets are for, and at what the airframe's bank and lift allow on the slowest
    leg.

    Args:
        fastest_m_s: (segments,) largest ground speed on each of the path's segments.
    """
    airframe = scenario.airframe.airframe()
    slowest = float(path.reference.leg_airspeed_m_s.min())
    load = max(1.0, lift_max_n(slowest, airframe) / (airframe.mass_kg * GRAVITY_M_S2))
    allowed = min(FILLET_BANK, airframe.bank_max, math.acos(1.0 / load))
    segments = path.reference.path.segments
    pulls = np.abs(segments[:, 4]) * fastest_m_s**2 / GRAVITY_M_S2
    faults = [
        f"banks by {math.degrees(math.atan(pulls[k])):.1f} deg at "
        f"{place(path.reference.points(segments[k, 0]))}, at most {math.degrees(allowed):.1f} are planned"
        for k in np.flatnonzero(pulls > math.tan(allowed) * (1 + 3 * RADIUS_TOLERANCE))
    ]
    return math.degrees(math.atan(float(pulls.max()))), faults


def _highest_m(reference: Reference) -> float:
    """Largest altitude along the path: at an end of a quadratic piece, or at its crest."""
    start, _, c1, c2 = reference.altitude.T
    bent = c2 < 0.0
    crests = start[bent] - c1[bent] / (2.0 * c2[bent])
    ends = np.append(reference.altitude[1:, 0], np.inf)[bent]
    s_m = np.concatenate([start, crests[(crests > start[bent]) & (crests < ends)], [0.0, reference.length_m]])
    return float(reference.points(np.clip(s_m, 0.0, reference.length_m))[:, 2].max())
