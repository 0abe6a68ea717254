"""A run's missions as files for autopilots, other ground stations, maps and globes."""

import logging
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from gcs.vehicle_plans import VehiclePlan, vehicle_plans
from missions.altitude_frame import AltitudeFrame, GroundAmsl
from missions.autopilot import Autopilot
from missions.dialect import in_dialect
from missions.environment import ground_height_m
from missions.errors import InputError
from missions.formats.czml import write_czml
from missions.formats.geojson import write_geojson
from missions.formats.kml import write_kml
from missions.formats.qgc_plan import write_plan
from missions.formats.scene import Scene
from missions.formats.waypoints import write_waypoints
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

_log = logging.getLogger(__name__)

_SCENE_WRITERS: Mapping[str, Callable[[Scene, Path], None]] = {
    "kml": write_kml,
    "czml": write_czml,
    "geojson": write_geojson,
}


@dataclass(frozen=True)
class ExportOptions:
    """What is to be written.

    Attributes:
        file_format: "plan" or "waypoints", for autopilots; "kml", "czml" or "geojson", for maps.
        autopilot: that is to fly it; of no matter to maps.
        altitude: what altitudes are above; maps get them AMSL.
        landing: whether vehicles land below their targets, instead of circling there.
    """

    file_format: str
    autopilot: Autopilot = Autopilot.ardupilot
    altitude: AltitudeFrame = AltitudeFrame.amsl
    landing: bool = False

    @property
    def for_maps(self) -> bool:
        """Whether the format is one for maps and globes."""
        return self.file_format in _SCENE_WRITERS


@dataclass(frozen=True)
class Exported:
    """What was written, and what an operator is to know of it."""

    files: tuple[Path, ...]
    notes: tuple[str, ...]


def export(scenario: Scenario, formation: FormationPlan, options: ExportOptions, folder: Path) -> Exported:
    """Write each vehicle's mission as <sysid>-<name>.<format>, and for maps all together as <scenario>.<format>.

    Raises:
        InputError: a file cannot be written, or the autopilot would not take a mission.
    """
    vehicles = vehicle_plans(scenario, formation, landing=options.landing)
    if options.for_maps:
        if options.altitude is not AltitudeFrame.amsl:
            raise InputError(f"--frame {options.altitude}: a {options.file_format} holds altitudes AMSL; leave it out")
        return Exported(tuple(_write_maps(scenario, formation, vehicles, options.file_format, folder)), ())
    ground = ground_amsl_m(scenario)
    files = []
    for vehicle in vehicles:
        try:
            plan = in_dialect(vehicle.plan, options.autopilot, options.altitude, ground)
        except InputError as error:
            raise InputError(f"vehicle {vehicle.sysid}: {error}") from None
        path = folder / f"{vehicle.sysid}-{vehicle.name}.{options.file_format}"
        if options.file_format == "plan":
            cruise_m_s = scenario.airframe.airspeed_cruise_m_s
            write_plan(plan, path, cruise_speed_m_s=cruise_m_s, autopilot=options.autopilot)
        else:
            write_waypoints(plan.mission, path)
        files.append(path)
        _log.debug("%s written", path)
    return Exported(tuple(files), tuple(_notes(scenario, vehicles, options)))


def ground_amsl_m(scenario: Scenario) -> GroundAmsl:
    """The altitude AMSL of a scenario's ground at a place."""
    frame, terrain = scenario.frame, scenario.environment.terrain
    return lambda lat_e7, lon_e7: ground_height_m(*frame.from_e7(lat_e7, lon_e7), terrain) + frame.alt_m


def _write_maps(
    scenario: Scenario, formation: FormationPlan, vehicles: Sequence[VehiclePlan], file_format: str, folder: Path
) -> Iterable[Path]:
    from gcs.scene import scene

    whole = scene(scenario, formation, {vehicle.sysid: vehicle.plan.mission for vehicle in vehicles})
    together = folder / f"{scenario.name}.{file_format}"
    _SCENE_WRITERS[file_format](whole, together)
    yield together
    for track in whole.tracks:
        path = folder / f"{track.sysid}-{track.name}.{file_format}"
        _SCENE_WRITERS[file_format](replace(whole, name=f"{scenario.name}: {track.name}", tracks=(track,)), path)
        yield path


def _notes(scenario: Scenario, vehicles: Sequence[VehiclePlan], options: ExportOptions) -> Iterable[str]:
    if options.altitude is AltitudeFrame.terrain:
        if scenario.raster is None:
            yield (
                "terrain: the scenario's ground is synthetic: an autopilot counts altitudes from its own terrain "
                "database, which has other ground; fly these files in no real place"
            )
        else:
            yield "terrain: an autopilot takes the ground from its own database, and follows it between waypoints"
    if options.file_format == "waypoints":
        yield "waypoints: the format has no fence and no rally points; export --format plan for those"
        return
    unfenced: dict[str, list[int]] = {}
    for vehicle in vehicles:
        for name in vehicle.unfenced:
            unfenced.setdefault(name, []).append(vehicle.sysid)
    for name, sysids in sorted(unfenced.items()):
        listed = ", ".join(map(str, sysids))
        yield f"{name}: is in no fence of {listed}, planned to fly over it, through it or along its edge"
    heights = ", ".join(f"{vehicle.sysid}: {vehicle.return_height_m:g} m" for vehicle in vehicles)
    if options.autopilot is Autopilot.px4:
        yield f"PX4 needs no rally point to come home: set RTL_RETURN_ALT, clear of ground and obstacles: {heights}"
    else:
        limit_km = math.ceil(max(vehicle.farthest_m for vehicle in vehicles) / 1000.0)
        yield f"rally points are at home, so high that any straight way back is clear: {heights}"
        yield f"rally points farther away than RALLY_LIMIT_KM do not count: set it to {limit_km} or more"
