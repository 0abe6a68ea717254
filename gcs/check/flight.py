"""The flight of a mission as an endpoint plans it: the stages of its itinerary, one after another."""

import math
from dataclasses import dataclass, replace

import numpy as np

from gcs.check.chain import chained
from gcs.check.straight_and_round import circled, climbed_out, end_of, slopes_m
from missions.commands import Command
from missions.environment import ground_height_m
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.reference import Reference
from missions.reference.reference import position_m
from missions.scenario import Scenario
from missions.vehicle_plan import Plan
from sitl.circling import Circling
from sitl.flight import Vector
from sitl.homing import refuge
from sitl.itinerary import Flyer, Itinerary, Start
from sitl.parameters import Parameters, arduplane_parameters
from sitl.stages.circle import CircleStage, Until
from sitl.stages.path import PathStage
from sitl.store import Store
from sitl.swarm import SwarmOptions, vehicle_configs

MOST_STAGES = 400
ON_GROUND_M = 20.0
"""A home this near the ground stands on it: maps differ."""
ONE_ROUND = 1.2
"""Turns from where a circle counts as reached: all of it."""


@dataclass(frozen=True)
class Flight:
    """What an endpoint would fly.

    Attributes:
        whole: all stages, and one round of the circle at the end.
        paths: the stages that are paths through waypoints, and the arc length of the whole at which each begins.
        ended_m, ended_s: arc length and time at which the mission has been flown, before it circles.
        descent_m: arc length at which the way down to a landing begins; infinite without one.
    """

    whole: Reference
    paths: tuple[tuple[float, Reference], ...]
    ended_m: float
    ended_s: float
    descent_m: float

    def item_at(self, s_m: float) -> int:
        """The mission item that is flown to at an arc length of the whole."""
        corner = max(int(np.searchsorted(self.whole.path.corner_s_m, s_m - 1e-6)), 1)
        return self.whole.corner_seq[min(corner, len(self.whole.corner_seq) - 1)]


def planned_flight(plan: Plan, scenario: Scenario) -> Flight:
    """Fly a mission on paper.

    A jump for ever is followed once. Circles that depend on the vehicle's settings have their defaults.

    Raises:
        InputError: part of it cannot be flown; the message names the item.
    """
    mission = Mission(tuple(map(_jumping_once, plan.mission)))
    config = vehicle_configs(scenario, SwarmOptions(seed=1, delay_s=0.0))[0]
    parameters = Parameters(arduplane_parameters(config.sysid, config.airframe), Store())
    circling = Circling(config, parameters)

    def returning(here: Vector) -> CircleStage:
        goal = refuge(here, mission.home, plan.rally, config.frame, parameters)
        return CircleStage(circling.loiter(goal, parameters["RTL_RADIUS"]))

    flyer = Flyer(config.frame, config.airframe, config.terrain, config.forecast_wind_m_s, circling.loiter, returning)
    start = Start(_launcher_m(mission.home, scenario))
    itinerary = Itinerary(mission, flyer, start.position_m)
    return _flown(itinerary, start, scenario)


def _flown(itinerary: Itinerary, start: Start, scenario: Scenario) -> Flight:
    cruise_m_s = scenario.airframe.airspeed_cruise_m_s
    slopes = slopes_m(scenario, cruise_m_s)
    parts: list[Reference] = []
    paths: list[tuple[float, Reference]] = []
    mark, circles, descent_m = itinerary.first(), None, math.inf
    while mark.seq < len(itinerary.mission) and circles is None and len(parts) < MOST_STAGES:
        stage, _, mark = itinerary.stage(mark, start)
        begun_m = sum(part.length_m for part in parts)
        if stage is None:
            break
        if isinstance(stage, PathStage):
            part = stage.reference
            paths.append((begun_m, part))
            if stage.lands:
                descent_m = begun_m + float(part.path.corner_s_m[-2])
            elif stage.loiter_seq is not None:
                circles = stage.final_loiter(), stage.loiter_seq
        elif isinstance(stage, CircleStage):
            speed_m_s = stage.airspeed_m_s or cruise_m_s
            if stage.complete:
                circles = stage.loiter, stage.seq
            until = None if stage.complete else stage.until
            part = circled(start, stage.loiter, stage.seq, speed_m_s, slopes, until)
        else:
            part = climbed_out(start, stage.course, stage.z_m, stage.seq, cruise_m_s, slopes[1])
        parts.append(part)
        start = end_of(part)
    ended_m, ended_s = (sum(getattr(part, name) for part in parts) for name in ("length_m", "duration_s"))
    if circles is not None:
        loiter, seq = circles
        parts.append(circled(start, loiter, seq, cruise_m_s, slopes, Until(turns=ONE_ROUND)))
    if not parts:
        raise InputError("mission: no way to fly; add a NAV_WAYPOINT")
    return Flight(chained(parts), tuple(paths), ended_m, ended_s, descent_m)


def _jumping_once(item: MissionItem) -> MissionItem:
    for_ever = item.command == Command.DO_JUMP and item.param2 == -1.0
    return replace(item, param2=1.0) if for_ever else item


def _launcher_m(home: MissionItem, scenario: Scenario) -> Vector:
    x, y, z = position_m(home, home, scenario.frame)
    ground = ground_height_m(x, y, scenario.environment.terrain)
    return x, y, ground if abs(z - ground) <= ON_GROUND_M else z
