"""A vehicle's plan as its autopilot wants it: the one place that knows where ArduPilot and PX4 differ."""

from dataclasses import replace

from missions.altitude_frame import AltitudeFrame, GroundAmsl, in_altitude_frame
from missions.autopilot import Autopilot
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.px4 import px4_items, px4_kept, px4_mission
from missions.vehicle_plan import Plan


def in_dialect(plan: Plan, autopilot: Autopilot, altitude: AltitudeFrame, ground_amsl_m: GroundAmsl) -> Plan:
    """A plan as an autopilot wants it, home still item 0 of its mission.

    PX4 gets no rally points: it comes home by itself, ignores those near home, and lands at the altitude of others.

    Args:
        plan: with altitudes in any of the three frames.
        autopilot: that is to fly it.
        altitude: what altitudes are above; rally points stay above home.
        ground_amsl_m: of the terrain, for altitudes above it.

    Raises:
        InputError: the autopilot would not take it; the message says why.
    """
    if autopilot is Autopilot.ardupilot:
        return replace(plan, mission=in_altitude_frame(plan.mission, altitude, ground_amsl_m))
    if altitude is AltitudeFrame.terrain:
        raise InputError("terrain: PX4 refuses altitudes above terrain (MAV_FRAME 10); choose amsl or relative")
    return replace(plan, mission=px4_mission(in_altitude_frame(plan.mission, altitude, ground_amsl_m)), rally=())


def wire_items(mission: Mission, autopilot: Autopilot) -> tuple[MissionItem, ...]:
    """The items of an upload: ArduPilot has home as item 0, PX4 has not."""
    return mission.items if autopilot.home_is_item_0 else px4_items(mission)


def as_kept(item: MissionItem, autopilot: Autopilot) -> MissionItem:
    """An item as the autopilot gives it back: what has no meaning to PX4 it does not keep."""
    return px4_kept(item) if autopilot is Autopilot.px4 else item
