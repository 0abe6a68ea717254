"""Whether vehicles may fly references that are not a plan's: the limits that plans are verified against, by the same
proofs."""

from collections.abc import Mapping

import numpy as np

from missions.reference import Reference
from missions.scenario import Scenario
from planner.checks import TOLERANCE, TOLERANCE_M
from planner.limits import airspeed_range_m_s, flyable
from planner.proof.flight import spare_speeds
from planner.proof.separation import separations
from planner.proof.surroundings import surroundings
from planner.proof.tracks import Tracks


def leg_fault(reference: Reference, t_s: float, scenario: Scenario) -> str | None:
    """What is wrong with the leg that is flown at a time: its airspeed, its slope, or the power that they take."""
    leg = int(np.searchsorted(reference.corner_time_s, t_s, side="right")) - 1
    airspeed, slope = float(reference.leg_airspeed_m_s[leg]), float(reference.leg_slope[leg])
    climb = float(reference.leg_ground_speed_m_s[leg]) * slope
    if not flyable(airspeed, climb, *airspeed_range_m_s(scenario), scenario.airframe.airframe()):
        return f"no engine or airspeed for {airspeed:.1f} m/s, climbing {climb:.1f} m/s"
    if np.degrees(np.arctan(abs(slope))) > scenario.limits.climb_max_deg * (1.0 + TOLERANCE):
        return "too steep"
    return None


def fault(references: Mapping[int, Reference], scenario: Scenario) -> str | None:
    """The first limit that is not proven to hold at every instant; None when all are."""
    rows, names = list(references.values()), {one.sysid: one.name for one in scenario.vehicles}
    sysids, limits, tracks = list(references), scenario.limits, Tracks(list(references.values()))
    apart = separations(tracks, limits.separation_m)
    for k in np.flatnonzero(apart.of_pair.low < limits.separation_m - TOLERANCE_M):
        one, other = (names[sysids[row]] for row in apart.pairs[k])
        return f"{other} {apart.of_pair.value[k]:.0f} m from {one} after {apart.of_pair.at[k]:.0f} s"
    spare = spare_speeds(tracks, scenario)
    around = surroundings(tracks, rows, scenario)
    for least, wanted, what in (
        (spare.slow, 0.0, "too slow"),
        (spare.fast, 0.0, "too fast"),
        (spare.descent, 0.0, "descends too fast"),
        (spare.climb, 0.0, "climbs too fast"),
        (around.ground.on_ground, 0.0, "too near to the ground"),
        (around.ground.spare, 0.0, "too near to the ground"),
        (around.walls, limits.obstacle_margin_m, "too near to an obstacle"),
        (around.room, 0.0, "outside the area"),
    ):
        for row in np.flatnonzero(least.low < wanted - TOLERANCE_M):
            return f"{names[sysids[row]]} {what}"
    return None
