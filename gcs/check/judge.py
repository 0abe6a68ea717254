"""What limits say of one flight: ground, walls, fence, altitude, angles, banks, legs, speeds, power, endurance."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from gcs.check.fence import room_m
from gcs.check.flight import Flight
from gcs.check.problem import Problem
from missions.airframe import GRAVITY_M_S2, Airframe, lift_max_n
from missions.fence import Fence, FenceCircle
from missions.reference import Reference, airspeed_on_track
from missions.scenario import Scenario
from planner.checks import TOLERANCE, TOLERANCE_M
from planner.limits import power_share
from planner.proof.flight import spare_speeds
from planner.proof.surroundings import clearances, room, walls
from planner.proof.tracks import Tracks

FloatArray = npt.NDArray[np.float64]

ROUNDED_M = 5.0
"""A leg along the arcs at its ends is shorter than from corner to corner, which is what a plan is held to."""
STEEPER = 0.02
"""Part by which a climb may be steeper along arcs, and into the circle at the end, than from corner to corner."""
MOST_POWER = 1.0
"""Part of the power there is that a leg may take."""


@dataclass(frozen=True)
class Judge:
    """Judges one flight.

    Attributes:
        file: that it is of.
        flight: what is flown.
        fence: the file's own.
        scenario: with the limits, the airframe and the ground.
        ground_known: whether heights above ground mean anything.
        limits_given: whether the scenario's limits on legs, turns and the area are anybody's wish.
        endurance_s, range_m: what there is fuel for.
    """

    file: Path
    flight: Flight
    fence: Fence
    scenario: Scenario
    ground_known: bool
    limits_given: bool
    endurance_s: float = math.inf
    range_m: float = math.inf

    def problems(self) -> list[Problem]:
        """All of them, in the order of what they are about."""
        tracks = Tracks([self.flight.whole])
        found = [*self._fence(tracks), *self._angles(), *self._banks(tracks), *self._speeds(tracks), *self._power()]
        if self.ground_known:
            found = [*self._ground(), *found]
        if self.limits_given:
            found += [*self._walls(tracks), *self._area(tracks), *self._legs()]
        return found + list(self._fuel())

    def _at(self, s_m: float, what: str, value: str, limit: str) -> Problem:
        x, y, _ = self.flight.whole.points(np.array(s_m)).tolist()
        lat_deg, lon_deg = self.scenario.frame.to_geodetic(x, y)
        return Problem(
            str(self.file), self.flight.item_at(s_m), what, value, limit, round(lat_deg, 7), round(lon_deg, 7)
        )

    def _ground(self) -> Iterator[Problem]:
        """Height above ground, as the planner asks for it: growing after the launch; not on the way to a landing."""
        whole = self.flight.whole
        cut_m = min(self.flight.descent_m, whole.length_m)
        above = Tracks([replace(whole, path=replace(whole.path, length_m=cut_m))])
        ground, limits = clearances(above, self.scenario), self.scenario.limits
        if ground.on_ground.low[0] < -TOLERANCE_M:
            s_m = float(ground.on_ground.at[0])
            yield self._at(s_m, "height above ground", f"{ground.on_ground.value[0]:.0f} m", "0 m")
        if ground.spare.low[0] < -TOLERANCE_M:
            s_m = float(ground.spare.at[0])
            wanted = limits.clearance_m * min(1.0, s_m / limits.climb_out_m)
            yield self._at(s_m, "height above ground", f"{ground.spare.value[0] + wanted:.0f} m", f"{wanted:.0f} m")

    def _walls(self, tracks: Tracks) -> Iterator[Problem]:
        least, wanted = walls(tracks, self.scenario), self.scenario.limits.obstacle_margin_m
        if least.low[0] < wanted - TOLERANCE_M:
            yield self._at(float(least.at[0]), "distance from an obstacle", f"{least.value[0]:.0f} m", f"{wanted:g} m")

    def _area(self, tracks: Tracks) -> Iterator[Problem]:
        least = room(tracks, self.scenario)
        if least.low[0] < -TOLERANCE_M:
            yield self._at(float(least.at[0]), "outside the scenario's area", f"by {-least.value[0]:.0f} m", "0 m")

    def _fence(self, tracks: Tracks) -> Iterator[Problem]:
        for index, area in enumerate(self.fence.areas):
            least = room_m(tracks, self.fence, index, self.scenario.frame)
            if least.low[0] < -TOLERANCE_M:
                shape = "circle" if isinstance(area, FenceCircle) else "polygon"
                side = "outside" if area.inclusion else "inside"
                what = f"{side} fence area {index + 1}, a {shape} to stay {'in' if area.inclusion else 'out of'}"
                yield self._at(float(least.at[0]), what, f"by {-least.value[0]:.0f} m", "0 m")

    def _angles(self) -> Iterator[Problem]:
        """Steepest climb and descent: at the ends of the altitude's pieces. A landing has its own check, and how
        steeply it climbs on its circle at the end a vehicle chooses."""
        whole, most = self.flight.whole, self.scenario.limits.climb_max_deg
        until_m = min(self.flight.descent_m, self.flight.ended_m, whole.length_m)
        inside = whole.altitude[:, 0]
        ends = np.clip(np.concatenate([inside, inside[1:] - 1e-3, [whole.length_m]]), 0.0, whole.length_m)
        s_m = np.unique(np.append(ends[ends < until_m], max(until_m - 1e-3, 0.0)))
        angles = np.degrees(np.arctan(whole.slopes(s_m)))
        for what, sign in (("climb", 1.0), ("descent", -1.0)):
            k = int(np.argmax(sign * angles))
            if sign * angles[k] > most * (1 + STEEPER):
                yield self._at(float(s_m[k]), f"{what} angle", f"{abs(angles[k]):.1f} deg", f"{most:g} deg")

    def _banks(self, tracks: Tracks) -> Iterator[Problem]:
        """Steepest bank at the planned speed, and corners that are left sharp."""
        airframe = self.scenario.airframe.airframe()
        segments = self.flight.whole.path.segments
        load = lift_max_n(float(self.flight.whole.leg_airspeed_m_s.min()), airframe) / (airframe.mass_kg * GRAVITY_M_S2)
        allowed = min(airframe.bank_max, math.acos(1.0 / max(load, 1.0)))
        pulls = np.abs(segments[:, 4]) * tracks.fastest_m_s(0) ** 2 / GRAVITY_M_S2
        k = int(np.argmax(pulls))
        if (bank := math.atan(pulls[k])) > allowed * (1 + TOLERANCE):
            value, limit = (f"{math.degrees(angle):.0f} deg" for angle in (bank, allowed))
            yield self._at(float(segments[k, 0]) + 1e-3, "bank in a turn", value, limit)
        for begun_m, path in self.flight.paths:
            for k in np.flatnonzero(path.path.corner_radius_m == 0.0).tolist():
                turn = f"{math.degrees(abs(path.path.corner_turn[k])):.0f} deg"
                yield self._at(begun_m + float(path.path.corner_s_m[k]), "turn without room for an arc", turn, "")

    def _legs(self) -> Iterator[Problem]:
        """Lengths and turns that a scenario allows."""
        limits = self.scenario.limits
        for begun_m, path in self.flight.paths:
            corners = path.path.corner_s_m
            for k, length in enumerate(np.diff(corners).tolist()):
                for broken, limit in (
                    (length < limits.leg_min_m - ROUNDED_M, limits.leg_min_m),
                    (length > limits.leg_max_m + TOLERANCE_M, limits.leg_max_m),
                ):
                    if broken and not (begun_m + corners[k + 1] > self.flight.descent_m):
                        yield self._at(begun_m + float(corners[k + 1]), "leg length", f"{length:.0f} m", f"{limit:g} m")
            turns = np.degrees(np.abs(path.path.corner_turn))
            for k in np.flatnonzero(turns > limits.turn_max_deg * (1 + TOLERANCE)).tolist():
                s_m = begun_m + float(corners[k])
                yield self._at(s_m, "turn", f"{turns[k]:.0f} deg", f"{limits.turn_max_deg:g} deg")

    def _speeds(self, tracks: Tracks) -> Iterator[Problem]:
        spare, airframe, whole = spare_speeds(tracks, self.scenario), self.scenario.airframe, self.flight.whole
        for least, what, limit, sign in (
            (spare.slow, "airspeed", airframe.airspeed_min_m_s, -1.0),
            (spare.fast, "airspeed", airframe.airspeed_max_m_s, 1.0),
            (spare.descent, "climb rate", airframe.climb_rate_min_m_s, -1.0),
            (spare.climb, "climb rate", airframe.climb_rate_max_m_s, 1.0),
        ):
            if least.low[0] < -TOLERANCE_M:
                s_m = float(whole.arc_lengths(least.at[0]))
                yield self._at(s_m, what, f"{limit - sign * least.value[0]:.1f} m/s", f"{limit:g} m/s")

    def _power(self) -> Iterator[Problem]:
        """The leg of each path that takes the most of the power there is, where that is too much."""
        airframe, wind = self.scenario.airframe.airframe(), self.scenario.wind.forecast_m_s
        for begun_m, path in self.flight.paths:
            shares = [_power_share(path, leg, wind, airframe) for leg in range(len(path.leg_slope))]
            k = int(np.argmax(shares))
            if shares[k] > MOST_POWER + TOLERANCE:
                s_m = begun_m + float(path.path.corner_s_m[k + 1])
                yield self._at(s_m, "power for a climb", f"{shares[k]:.0%}", f"{MOST_POWER:.0%}")

    def _fuel(self) -> Iterator[Problem]:
        flight, file = self.flight, str(self.file)
        if flight.ended_s > self.endurance_s:
            minutes, most = flight.ended_s / 60.0, self.endurance_s / 60.0
            yield Problem(file, None, "time of flight", f"{minutes:.1f} min", f"{most:g} min")
        if flight.ended_m > self.range_m:
            km, most = flight.ended_m / 1000.0, self.range_m / 1000.0
            yield Problem(file, None, "distance flown", f"{km:.1f} km", f"{most:g} km")


def _power_share(path: Reference, leg: int, wind: tuple[float, float], airframe: Airframe) -> float:
    """Part of the power there is that a leg takes."""
    ground, slope = float(path.leg_ground_speed_m_s[leg]), float(path.leg_slope[leg])
    middle = (path.path.corner_s_m[leg] + path.path.corner_s_m[leg + 1]) / 2
    airspeed = airspeed_on_track(ground, slope, float(path.path.at(middle)[2]), wind)
    return power_share(airspeed, ground * slope / airspeed, airframe)
