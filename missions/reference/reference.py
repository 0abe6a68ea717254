"""Where a vehicle should be at each moment: path, altitude and schedule of one mission."""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from missions.airframe import GRAVITY_M_S2, Airframe
from missions.commands import NAVIGATION, Command, Frame
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from missions.reference.path import Arc, FilletedPath, fillet
from missions.reference.smoothing import moving_average, quadratics_at
from missions.reference.wind_triangle import airspeed_on_track, ground_speed_on_track

FloatArray = npt.NDArray[np.float64]

FILLET_BANK = math.radians(25.0)
"""Bank at which the fastest leg's ground speed flies the fillets."""
ALTITUDE_WINDOW_M = 120.0
SCHEDULE_WINDOW_S = 8.0
SHARPEST_TURN = math.radians(150.0)
"""Beyond, a corner has no room for an arc that an aircraft could fly."""
FARTHEST_M = 1e6
"""From the frame's origin; farther out the projection is no use."""
SAME_PLACE_M = 1.0
"""A loiter this close to the waypoint before it is flown around that waypoint."""


class ReferenceTables(NamedTuple):
    """The reference as tables for the compiled core; arrays there, lists of tuples in an endpoint.

    Attributes:
        segments: (n, 5) of `missions.reference.path`.
        altitude: (m, 4) quadratic pieces of z over arc length.
        schedule: (k, 4) quadratic pieces of s_ref over time.
        airspeeds: (l, 2) arc length from which an airspeed is commanded, and that airspeed.
        length_m, duration_s: of the whole.
    """

    segments: Any
    altitude: Any
    schedule: Any
    airspeeds: Any
    length_m: float
    duration_s: float


@dataclass(frozen=True)
class Reference:
    """A mission's path, altitude and schedule.

    Attributes:
        path: the filleted polyline in the plane.
        altitude: quadratic pieces (m, 4) of z over horizontal arc length.
        schedule: quadratic pieces (k, 4) of arc length over time since launch.
        duration_s: planned time from launch to arrival.
        corner_seq: mission item of each corner (0 is home).
        corner_time_s: planned time of passing each corner.
        leg_airspeed_m_s, leg_ground_speed_m_s: (legs,) commanded airspeed, and scheduled horizontal ground speed.
        leg_slope: (legs,) dz/ds of each leg.
        target_m: (x, y, z) of the last corner.
        loiter_radius_m: of the loiter at the end; positive turns clockwise (MAVLink).
        loiter_z_m: its altitude above the datum.
    """

    path: FilletedPath
    altitude: FloatArray
    schedule: FloatArray
    duration_s: float
    corner_seq: tuple[int, ...]
    corner_time_s: FloatArray
    leg_airspeed_m_s: FloatArray
    leg_ground_speed_m_s: FloatArray
    leg_slope: FloatArray
    target_m: tuple[float, float, float]
    loiter_radius_m: float
    loiter_z_m: float

    @property
    def length_m(self) -> float:
        """Horizontal arc length."""
        return self.path.length_m

    @property
    def target_heading(self) -> float:
        """Heading of the last leg, which the target's plane is normal to."""
        return float(self.path.segments[-1, 3])

    def points(self, s_m: FloatArray) -> FloatArray:
        """Positions (..., 3) at arc lengths (...)."""
        x, y, _, _ = self.path.at(s_m)
        z, _ = quadratics_at(s_m, self.altitude)
        return np.stack([x, y, z], axis=-1)

    def slopes(self, s_m: FloatArray) -> FloatArray:
        """dz/ds at arc lengths (...)."""
        return quadratics_at(s_m, self.altitude)[1]

    def arc_lengths(self, t_s: FloatArray) -> FloatArray:
        """s_ref(t) at times (...); past the arrival it goes on at the last speed."""
        return quadratics_at(t_s, self.schedule)[0]

    def positions(self, t_s: FloatArray) -> FloatArray:
        """ref(t) = path(s_ref(t)): planned positions (..., 3) at times (...) since launch."""
        return self.points(self.arc_lengths(t_s))

    def tables(self) -> ReferenceTables:
        """The reference for an endpoint, as lists of tuples."""
        starts = self.path.corner_s_m[:-1]
        return ReferenceTables(
            segments=[tuple(row) for row in self.path.segments.tolist()],
            altitude=[tuple(row) for row in self.altitude.tolist()],
            schedule=[tuple(row) for row in self.schedule.tolist()],
            airspeeds=list(zip(starts.tolist(), self.leg_airspeed_m_s.tolist(), strict=True)),
            length_m=self.length_m,
            duration_s=self.duration_s,
        )


class Speed(NamedTuple):
    """What a DO_CHANGE_SPEED item asks for: an airspeed, or a speed over ground."""

    m_s: float
    over_ground: bool


@dataclass(frozen=True)
class Way:
    """What a reference is made of.

    Attributes:
        corners_m: (x, y, z) of each corner, at least two.
        seqs: mission item of each corner.
        wanted: speed of each leg, one fewer than corners.
        loiter_radius_m: asked for at the end; positive turns clockwise, 0 for the default.
        loiter_z_m: altitude of that loiter above the datum.
    """

    corners_m: tuple[tuple[float, float, float], ...]
    seqs: tuple[int, ...]
    wanted: tuple[Speed, ...]
    loiter_radius_m: float
    loiter_z_m: float


def build_reference(
    mission: Mission, frame: LocalFrame, airframe: Airframe, forecast_wind_m_s: tuple[float, float]
) -> Reference:
    """Build the reference of a mission from what the wire carries of it (MODEL, section 6).

    The path starts at home (item 0), goes through every NAV_WAYPOINT and ends at the last one or at the first
    NAV_LOITER_UNLIM. DO_CHANGE_SPEED items set the legs' air or ground speeds from there on; the forecast wind turns
    one into the other. As on ArduPlane, speeds outside the airframe's limits are ignored, and latitude and longitude 0
    mean "where it is". NAV_TAKEOFF has no place of its own: the aircraft is launched along the first leg.

    Raises:
        InputError: the mission has no way to fly, turns too sharply, leads too far away, or a leg cannot be flown
            against the forecast wind.
    """
    corners: list[tuple[float, float, float]] = [position_m(mission.home, mission.home, frame)]
    seqs = [0]
    wanted: list[Speed] = []
    speed = Speed(airframe.airspeed_cruise_m_s, over_ground=False)
    loiter: MissionItem | None = None
    for seq, item in enumerate(mission.items[1:], start=1):
        if item.command == Command.DO_CHANGE_SPEED:
            speed = changed_speed(item, speed, airframe)
            continue
        if item.command not in NAVIGATION:
            continue
        position = place_m(seq, item, mission.home, frame, corners[-1])
        if item.command == Command.NAV_LOITER_UNLIM:
            loiter = item
        if loiter is None or math.dist(position[:2], corners[-1][:2]) >= SAME_PLACE_M:
            corners.append(position)
            seqs.append(seq)
            wanted.append(speed)
        if loiter is not None:
            break
    loiter_z_m = position_m(loiter, mission.home, frame)[2] if loiter is not None else corners[-1][2]
    way = Way(tuple(corners), tuple(seqs), tuple(wanted), loiter.param3 if loiter is not None else 0.0, loiter_z_m)
    return reference_of(way, airframe, forecast_wind_m_s)


def reference_of(
    way: Way, airframe: Airframe, forecast_wind_m_s: tuple[float, float], lead_in: Arc | None = None
) -> Reference:
    """The reference of a way; with `lead_in`, of that arc and then the way, whose first corner is the arc's end.

    Raises:
        InputError: as `build_reference`.
    """
    seqs, wanted = way.seqs, way.wanted
    points = np.array(way.corners_m)
    if len(points) < 2 or np.ptp(points[:, :2], axis=0).max() < SAME_PLACE_M:
        raise InputError("mission: no waypoint away from home; add a NAV_WAYPOINT")

    legs = np.diff(points[:, :2], axis=0)
    headings = np.arctan2(legs[:, 1], legs[:, 0])

    def through(radius_m: float) -> FilletedPath:
        path = fillet(points[:, :2], radius_m)
        return path if lead_in is None else path.after(lead_in)

    def speeds(path: FilletedPath) -> tuple[FloatArray, FloatArray, FloatArray]:
        """(airspeed, ground speed, slope) of each leg."""
        arc = np.maximum(np.diff(path.corner_s_m), 1e-9)
        slopes = np.where(arc > SAME_PLACE_M, np.diff(points[:, 2]) / arc, 0.0)
        pairs = []
        for i, want in enumerate(wanted):
            try:
                pairs.append(_leg_speeds(want, float(slopes[i]), float(headings[i]), airframe, forecast_wind_m_s))
            except ValueError as error:
                raise InputError(f"mission item {seqs[i + 1]}: {error}") from None
        airspeeds, ground_speeds = np.array(pairs).T
        return airspeeds, ground_speeds, slopes

    # The radius follows from the ground speeds, and they, through the slopes, weakly from the arcs: correct once.
    _, ground_speed, _ = speeds(through(0.0))
    path = through(fillet_radius_m(float(ground_speed.max())))
    airspeed, ground_speed, slope = speeds(path)
    for k in np.flatnonzero(np.abs(path.corner_turn) > SHARPEST_TURN):
        raise InputError(
            f"mission item {seqs[k]}: a turn of {math.degrees(abs(path.corner_turn[k])):.0f} degrees; "
            f"at most {math.degrees(SHARPEST_TURN):.0f} are flown, put a waypoint more into it"
        )

    arc = np.diff(path.corner_s_m)
    corner_time = np.concatenate([[0.0], np.cumsum(arc / ground_speed)])
    duration = float(corner_time[-1])
    apart = np.concatenate([[True], arc > 0.0])
    last_of_place = np.concatenate([arc > 0.0, [True]])
    schedule = moving_average(corner_time[apart], path.corner_s_m[apart], SCHEDULE_WINDOW_S)
    ends, _ = quadratics_at(np.array([0.0, duration]), schedule)
    schedule[:, 1] -= ends[0]
    schedule[:, 1:] *= path.length_m / (ends[1] - ends[0])

    return Reference(
        path=path,
        altitude=moving_average(path.corner_s_m[last_of_place], points[last_of_place, 2], ALTITUDE_WINDOW_M),
        schedule=schedule,
        duration_s=duration,
        corner_seq=seqs,
        corner_time_s=corner_time,
        leg_airspeed_m_s=airspeed,
        leg_ground_speed_m_s=ground_speed,
        leg_slope=slope,
        target_m=way.corners_m[-1],
        loiter_radius_m=_loiter_radius_m(way.loiter_radius_m, float(ground_speed.max())),
        loiter_z_m=way.loiter_z_m,
    )


def changed_speed(item: MissionItem, speed: Speed, airframe: Airframe) -> Speed:
    """The speed after a DO_CHANGE_SPEED item: unchanged when that asks for what is not flown."""
    if item.param2 == -2:
        return Speed(airframe.airspeed_cruise_m_s, over_ground=False)
    if item.param1 == 1 or (item.param1 == 0 and _flyable(item.param2, airframe)):
        return Speed(item.param2, over_ground=item.param1 == 1)
    return speed


def place_m(
    seq: int, item: MissionItem, home: MissionItem, frame: LocalFrame, before_m: tuple[float, float, float]
) -> tuple[float, float, float]:
    """(x, y, z) of mission item `seq`, at the place before where its latitude and longitude are 0.

    Raises:
        InputError: it is too far away for the projection.
    """
    position = position_m(item, home, frame)
    if item.lat_e7 == 0 and item.lon_e7 == 0:
        position = (*before_m[:2], position[2])
    if not math.hypot(*position[:2]) < FARTHEST_M:
        raise InputError(f"mission item {seq}: more than {FARTHEST_M / 1000:g} km from the scenario's origin")
    return position


def _flyable(airspeed_m_s: float, airframe: Airframe) -> bool:
    return airframe.airspeed_min_m_s <= airspeed_m_s <= airframe.airspeed_max_m_s


def _leg_speeds(
    wanted: Speed, slope: float, heading: float, airframe: Airframe, wind_m_s: tuple[float, float]
) -> tuple[float, float]:
    """(airspeed, ground speed) of a leg; at cruise when the wanted ground speed takes an airspeed that is not flown.

    Raises:
        ValueError: the wind lets nothing through.
    """
    if wanted.over_ground:
        airspeed = airspeed_on_track(wanted.m_s, slope, heading, wind_m_s)
        if wanted.m_s > 0.0 and _flyable(airspeed, airframe):
            return airspeed, wanted.m_s
    airspeed = airframe.airspeed_cruise_m_s if wanted.over_ground else wanted.m_s
    return airspeed, ground_speed_on_track(airspeed, slope, heading, wind_m_s)


def fillet_radius_m(ground_speed_m_s: float) -> float:
    """Radius of the arc that a ground speed flies at `FILLET_BANK`."""
    return ground_speed_m_s**2 / (GRAVITY_M_S2 * math.tan(FILLET_BANK))


def _loiter_radius_m(wanted: float, ground_speed_m_s: float) -> float:
    """Radius of the final loiter: the item's own (param3), but never tighter than the fillets."""
    least = fillet_radius_m(ground_speed_m_s)
    wanted = wanted if math.isfinite(wanted) else 0.0
    return math.copysign(max(abs(wanted), least), wanted)


def position_m(item: MissionItem, home: MissionItem, frame: LocalFrame) -> tuple[float, float, float]:
    """(x, y, z) of an item in the local frame."""
    x, y = frame.from_e7(item.lat_e7, item.lon_e7)
    amsl = item.alt_m + (home.alt_m if item.frame == Frame.GLOBAL_RELATIVE_ALT else 0.0)
    return x, y, amsl - frame.alt_m
