"""A run as a scene for maps and globes."""

import math
from collections.abc import Iterator, Mapping

import numpy as np
from matplotlib.colors import to_hex

from gcs.figures.style import vehicle_colours
from missions.commands import PLACES, Command
from missions.environment import Obstacle, Radar, ground_height_m
from missions.formats.scene import Round, Scene, Stop, Track
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

STEP_S = 2.0
"""Between a track's samples."""
RIM_PLACES = 72
_NAMES = {Command.NAV_TAKEOFF: "take-off", Command.NAV_LAND: "landing", Command.NAV_WAYPOINT: "waypoint"}


def scene(scenario: Scenario, formation: FormationPlan, missions: Mapping[int, Mission]) -> Scene:
    """All vehicles of a run and their surroundings.

    Args:
        scenario: of the run.
        formation: its plan, whose references are the tracks.
        missions: the items to show, by sysid; altitudes AMSL.
    """
    frame, environment = scenario.frame, scenario.environment
    colours, references = vehicle_colours(scenario), formation.references(scenario)
    tracks = [
        _track(uav.sysid, uav.name, to_hex(colours[uav.sysid]), references[uav.sysid], missions[uav.sysid], frame)
        for uav in formation.uavs
    ]
    area = environment.area
    corners = (
        (area.x_min_m, area.y_min_m),
        (area.x_max_m, area.y_min_m),
        (area.x_max_m, area.y_max_m),
        (area.x_min_m, area.y_max_m),
    )
    obstacles = [
        (obstacle, ground_height_m(obstacle.x_m, obstacle.y_m, environment.terrain), obstacle.top_m)
        for obstacle in environment.obstacles
    ]
    radars = [(radar, radar.z_m - radar.radius_m, radar.z_m + radar.radius_m) for radar in environment.radars]
    return Scene(
        name=scenario.name,
        description=scenario.description,
        tracks=tuple(tracks),
        radars=tuple(_round(f"radar {i}", *radar, frame) for i, radar in enumerate(radars, start=1)),
        obstacles=tuple(_round(f"obstacle {i}", *obstacle, frame) for i, obstacle in enumerate(obstacles, start=1)),
        area=tuple(frame.to_geodetic(x, y) for x, y in corners),
    )


def _track(sysid: int, name: str, colour: str, reference: Reference, mission: Mission, frame: LocalFrame) -> Track:
    time_s = np.append(np.arange(0.0, reference.duration_s, STEP_S), reference.duration_s)
    points = reference.positions(time_s)
    lat_deg, lon_deg = np.array([frame.to_geodetic(x, y) for x, y in points[:, :2].tolist()]).T
    speed_m_s = np.gradient(reference.arc_lengths(time_s), time_s)
    stops = tuple(_stops(mission, reference))
    return Track(sysid, name, colour, time_s, lat_deg, lon_deg, points[:, 2] + frame.alt_m, speed_m_s, stops)


def _stops(mission: Mission, reference: Reference) -> Iterator[Stop]:
    times_s = dict(zip(reference.corner_seq, reference.corner_time_s.tolist(), strict=True))
    airspeed_m_s = None
    for seq, item in enumerate(mission):
        if item.command == Command.DO_CHANGE_SPEED:
            airspeed_m_s = round(item.param2, 3)
        if item.command in PLACES:
            yield Stop(
                seq=seq,
                name="home" if seq == 0 else _NAMES.get(Command(item.command), "loiter"),
                lat_deg=item.lat_deg,
                lon_deg=item.lon_deg,
                alt_m=item.alt_m,
                acceptance_m=item.param2 if seq > 0 and item.command == Command.NAV_WAYPOINT else None,
                airspeed_m_s=airspeed_m_s,
                time_s=times_s.get(seq),
            )


def _round(name: str, place: Radar | Obstacle, bottom_m: float, top_m: float, frame: LocalFrame) -> Round:
    lat_deg, lon_deg = frame.to_geodetic(place.x_m, place.y_m)
    angles = [2.0 * math.pi * i / RIM_PLACES for i in range(RIM_PLACES)]
    around = [(place.x_m + place.radius_m * math.cos(a), place.y_m + place.radius_m * math.sin(a)) for a in angles]
    rim = tuple(frame.to_geodetic(x, y) for x, y in around)
    return Round(name, lat_deg, lon_deg, place.radius_m, bottom_m + frame.alt_m, top_m + frame.alt_m, rim)
