"""How fast each leg is flown: a common arrival, or given times at the corners (MODEL, section 6, Schedule)."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np
import numpy.typing as npt

from missions.compiled import compile_shared, jit
from missions.errors import InputError
from missions.reference import airspeed_on_track, fillet
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario
from planner.limits import POWER_SHARE, airspeed_range_m_s, flyable, power_share

FloatArray = npt.NDArray[np.float64]

_airspeed_on_track, _flyable = compile_shared(airspeed_on_track), compile_shared(flyable)

ROUNDS = 5
"""The fillets' radius follows from the speeds and these, through the arcs, weakly from the radius: a fixed point that
each round brings nearer by a factor of 100 or more."""
SPEED_STEP_M_S = 0.1
"""Between the speeds of the longest path that are tried for a common arrival."""
WINDOW_EDGE = 0.25
"""Part of the window of possible arrivals that is left free at either end, so that both the fastest and the slowest
aircraft have speed to correct with."""


@dataclass(frozen=True)
class Schedule:
    """Speeds of one path's legs.

    Attributes:
        arcs_m: (legs,) horizontal length between the middles of the fillets.
        slopes: (legs,) dz/ds.
        ground_m_s: (legs,) horizontal ground speed.
        air_m_s: (legs,) airspeed in the forecast wind.
    """

    arcs_m: FloatArray
    slopes: FloatArray
    ground_m_s: FloatArray
    air_m_s: FloatArray

    @property
    def duration_s(self) -> float:
        """From launch to arrival."""
        return float(np.sum(self.arcs_m / self.ground_m_s))


def timed_schedule(corners_m: FloatArray, times_s: FloatArray, wind_m_s: tuple[float, float]) -> Schedule:
    """The schedule that passes each corner of (m, 3) at its time (m,)."""
    ground = np.hypot(*np.diff(corners_m[:, :2], axis=0).T) / np.diff(times_s)
    for _ in range(ROUNDS):
        arcs = _arcs_m(corners_m, float(ground.max()))
        ground = arcs / np.diff(times_s)
    return _schedule(corners_m, arcs, ground, wind_m_s)


def even_schedule(corners_m: FloatArray, duration_s: float, wind_m_s: tuple[float, float]) -> Schedule:
    """The schedule that arrives after `duration_s` at one ground speed all the way."""
    speed = float(np.hypot(*np.diff(corners_m[:, :2], axis=0).T).sum()) / duration_s
    for _ in range(ROUNDS):
        arcs = _arcs_m(corners_m, speed)
        speed = float(arcs.sum()) / duration_s
    return _schedule(corners_m, arcs, np.full(len(arcs), speed), wind_m_s)


def common_arrival(names: Sequence[str], paths: Sequence[FloatArray], scenario: Scenario) -> list[Schedule]:
    """Schedules by which all arrive together, the longest path flown near the airframe's cruise.

    Raises:
        InputError: there is no arrival that all can make; names UAV and leg.
    """
    wind, cruise = scenario.wind.forecast_m_s, scenario.airframe.airspeed_cruise_m_s
    longest = max(float(np.hypot(*np.diff(path[:, :2], axis=0).T).sum()) for path in paths)
    at_cruise = [even_schedule(path, longest / cruise, wind) for path in paths]

    def faults(duration_s: float) -> list[str]:
        """The first fault of each UAV; the fillets at cruise are near enough."""
        speedup = longest / cruise / duration_s
        found = []
        for name, path, draft in zip(names, paths, at_cruise, strict=True):
            schedule = _schedule(path, draft.arcs_m, draft.ground_m_s * speedup, wind)
            found += [f"{name}: {fault}" for fault in islice(leg_faults(schedule, scenario), 1)]
        return found

    slowest, fastest = airspeed_range_m_s(scenario)
    blowing = math.hypot(*wind)
    durations = longest / np.arange(fastest + blowing, max(slowest - blowing, 1.0), -SPEED_STEP_M_S)
    legs = np.concatenate([np.diff(path, axis=0) for path in paths])
    possible = durations[
        flyable_at(
            longest / cruise / durations,
            np.concatenate([draft.ground_m_s for draft in at_cruise]),
            np.concatenate([draft.slopes for draft in at_cruise]),
            np.arctan2(legs[:, 1], legs[:, 0]),
            wind,
            (slowest, fastest),
            scenario.airframe.airframe(),
        )
    ].tolist()
    if not possible:
        faults_at = {duration: faults(duration) for duration in durations.tolist()}
        duration, found = min(faults_at.items(), key=lambda item: (len(item[1]), abs(item[0] - longest / cruise)))
        raise InputError(
            f"{scenario.name}: {found[0]}, to arrive with the others after {duration:.0f} s; "
            "bring the lengths of the paths nearer to each other, or lower the targets"
        )
    edge = WINDOW_EDGE * (max(possible) - min(possible))
    duration = min(max(longest / cruise, min(possible) + edge), max(possible) - edge)
    return [even_schedule(path, duration, wind) for path in paths]


def arrival_window_s(corners_m: FloatArray, scenario: Scenario) -> tuple[float, float] | None:
    """Soonest and latest arrival of one UAV at one ground speed all the way; None when it cannot fly its path."""
    wind = scenario.wind.forecast_m_s
    airspeeds = airspeed_range_m_s(scenario)
    blowing = math.hypot(*wind)
    length = float(np.hypot(*np.diff(corners_m[:, :2], axis=0).T).sum())
    speeds = np.arange(airspeeds[1] + blowing, max(airspeeds[0] - blowing, 1.0), -SPEED_STEP_M_S)
    draft = even_schedule(corners_m, length / scenario.airframe.airspeed_cruise_m_s, wind)
    legs = np.diff(corners_m, axis=0)
    possible = speeds[
        flyable_at(
            speeds / float(draft.ground_m_s[0]),
            draft.ground_m_s,
            draft.slopes,
            np.arctan2(legs[:, 1], legs[:, 0]),
            wind,
            airspeeds,
            scenario.airframe.airframe(),
        )
    ]
    flown = float(draft.arcs_m.sum())
    return (flown / float(possible.max()), flown / float(possible.min())) if len(possible) else None


@jit
def flyable_at(
    speedups: Any, ground_m_s: Any, slopes: Any, headings: Any, wind_m_s: Any, airspeeds_m_s: Any, airframe: Any
) -> Any:
    """At which of the speed-ups (n,) all legs (m,) are `flyable`; the first that is not settles it."""
    possible = np.ones(len(speedups), dtype=np.bool_)
    for i in range(len(speedups)):
        for k in range(len(ground_m_s)):
            ground = ground_m_s[k] * speedups[i]
            airspeed = _airspeed_on_track(ground, slopes[k], headings[k], wind_m_s)
            if not _flyable(airspeed, ground * slopes[k], airspeeds_m_s[0], airspeeds_m_s[1], airframe):
                possible[i] = False
                break
    return possible


def leg_faults(schedule: Schedule, scenario: Scenario) -> Iterator[str]:
    """Legs that the airframe cannot fly as planned, each as "leg 3: what is wrong"."""
    airframe = scenario.airframe.airframe()
    slowest, fastest = airspeed_range_m_s(scenario)
    for leg in range(len(schedule.air_m_s)):
        airspeed, climb_m_s = float(schedule.air_m_s[leg]), float(schedule.ground_m_s[leg] * schedule.slopes[leg])
        share = power_share(airspeed, climb_m_s / airspeed, airframe)
        if airspeed < slowest:
            yield f"leg {leg + 1}: airspeed {airspeed:.1f} m/s, less than {slowest:g}"
        elif airspeed > fastest:
            yield f"leg {leg + 1}: airspeed {airspeed:.1f} m/s, more than {fastest:g}"
        elif share > POWER_SHARE:
            yield f"leg {leg + 1}: {share:.0%} of the power there is at {airspeed:.1f} m/s, more than {POWER_SHARE:.0%}"
        elif not airframe.climb_rate_min_m_s <= climb_m_s <= airframe.climb_rate_max_m_s:
            yield f"leg {leg + 1}: climbs at {climb_m_s:.1f} m/s, outside the airframe's climb rates"


def _arcs_m(corners_m: FloatArray, fastest_m_s: float) -> FloatArray:
    """Lengths of the legs between the middles of fillets fit for a ground speed."""
    return np.diff(fillet(corners_m[:, :2], fillet_radius_m(fastest_m_s)).corner_s_m)


def _schedule(
    corners_m: FloatArray, arcs_m: FloatArray, ground_m_s: FloatArray, wind_m_s: tuple[float, float]
) -> Schedule:
    legs = np.diff(corners_m, axis=0)
    slopes = legs[:, 2] / arcs_m
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    air = [
        airspeed_on_track(ground, slope, heading, wind_m_s)
        for ground, slope, heading in zip(ground_m_s.tolist(), slopes.tolist(), headings.tolist(), strict=True)
    ]
    return Schedule(arcs_m, slopes, ground_m_s, np.array(air))
