"""A mission as stages: from a place in it and a place in the air to what is flown next."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from missions.airframe import Airframe
from missions.commands import Command
from missions.environment.terrain import Terrain, ground_height_m
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.mission import Mission, MissionItem
from missions.reference.lead_in import end_of, turn_towards
from missions.reference.path import SHORTEST_LEG_M, Arc
from missions.reference.reference import (
    SAME_PLACE_M,
    SHARPEST_TURN,
    Speed,
    Way,
    changed_speed,
    fillet_radius_m,
    place_m,
    position_m,
    reference_of,
)
from sitl.flight import Vector
from sitl.guidance.loiter_law import Loiter
from sitl.landing import approach_airspeed_m_s, check_approach
from sitl.stages.circle import CircleStage, Until
from sitl.stages.mark import Mark
from sitl.stages.path import PathStage, TakeoffItem
from sitl.stages.straight import ClimbOutStage

LONGEST_PATH = 60
"""Corners of one path stage: a jump that goes round for ever is flown in pieces of this length."""
ARRIVED_M = 20.0
"""A waypoint this near counts as reached when a stage begins in the air."""
ANY_ARC_TURN = math.radians(45.0)
TIGHTEST_ARC_M = 60.0
"""Sharper turns than the one need room for an arc of the other, or the path is flown in two stages there."""
LOWEST_CLIMB_OUT_M = 10.0
SETTLED_RADII = 2.5
SETTLED_Z_M = 40.0
"""So near the loiter before a landing, and so near its altitude, the approach begins from there."""
COUNTED = (Command.NAV_LOITER_TIME, Command.NAV_LOITER_TURNS, Command.NAV_LOITER_TO_ALT)
PLACES = (Command.NAV_WAYPOINT, Command.NAV_LOITER_UNLIM, *COUNTED, Command.NAV_LAND)
FLOWN = frozenset({*PLACES, Command.NAV_TAKEOFF, Command.NAV_RETURN_TO_LAUNCH})
KNOWN = FLOWN | {Command.DO_JUMP, Command.DO_CHANGE_SPEED, Command.DO_LAND_START}

Stage = PathStage | CircleStage | ClimbOutStage


class Start(NamedTuple):
    """Where a stage begins: position, and course over ground; None on the launcher."""

    position_m: Vector
    course: float | None = None


@dataclass(frozen=True)
class Flyer:
    """What flies a mission.

    Attributes:
        frame, airframe, terrain: as in `VehicleConfig`.
        wind_m_s: forecast, (east, north).
        loiter: the circle flown round a place for a radius that is asked for, signed as in MAVLink, 0 for the default.
        returning: the circle at the end of a NAV_RETURN_TO_LAUNCH item, by where that begins.
    """

    frame: LocalFrame
    airframe: Airframe
    terrain: Terrain
    wind_m_s: tuple[float, float]
    loiter: Callable[[Vector, float], Loiter]
    returning: Callable[[Vector], CircleStage]


class Itinerary:
    """One mission.

    Args:
        mission: home first.
        flyer: what flies it.
        start_m: the launcher it begins from.

    Raises:
        InputError: some of it cannot be flown; the message names the item and says why.
    """

    def __init__(self, mission: Mission, flyer: Flyer, start_m: Vector) -> None:
        self.mission = mission
        self._flyer = flyer
        for seq, item in enumerate(mission.items[1:], start=1):
            if item.command not in KNOWN:
                raise InputError(f"mission item {seq}: command {item.command} cannot be flown")
            if item.command == Command.DO_JUMP:
                self._check_jump(seq, item)
            if item.command == Command.NAV_LAND:
                self._check_landing(seq)
        self.flies = any(item.command in FLOWN for item in mission.items[1:])
        self.first_stage = self._check(start_m) if self.flies else None

    def first(self) -> Mark:
        """The beginning."""
        return Mark(1, Speed(self._flyer.airframe.airspeed_cruise_m_s, over_ground=False))

    def at(self, seq: int) -> Mark:
        """Item `seq`, with the speed that the items before it ask for, no jump counted."""
        mark = self.first()
        for item in self.mission.items[1:seq]:
            if item.command == Command.DO_CHANGE_SPEED:
                mark = mark._replace(speed=changed_speed(item, mark.speed, self._flyer.airframe))
        return mark._replace(seq=max(seq, 1))

    def landing_starts(self) -> list[int]:
        """The items DO_LAND_START."""
        return [seq for seq, item in enumerate(self.mission) if item.command == Command.DO_LAND_START]

    def place_m(self, seq: int) -> Vector:
        """Where item `seq` is; at the last place before it when it has none of its own."""
        place = position_m(self.mission.home, self.mission.home, self._flyer.frame)
        for at, item in enumerate(self.mission.items[1 : seq + 1], start=1):
            if item.command in PLACES:
                place = place_m(at, item, self.mission.home, self._flyer.frame, place)
        return place

    def stage(self, mark: Mark, start: Start, *, jumping: bool = True) -> tuple[Stage | None, list[int], Mark]:
        """What is flown next.

        Args:
            mark: where in the mission.
            start: where in the air.
            jumping: whether DO_JUMP is followed.

        Returns:
            The stage, None at the mission's end; the items that are reached at once; and where it goes on after them.

        Raises:
            InputError: it cannot be flown from here.
        """
        flyer, items = self._flyer, self.mission.items
        corners, seqs, wanted, marks = [start.position_m], [0], list[Speed](), list[Mark]()
        lead_in: list[Arc] = []
        takeoff: TakeoffItem | None = None
        reached: list[int] = []
        jumped: set[int] = set()  # since the last waypoint: a loop without one is left

        def path(after: Mark, *, loiter: MissionItem | None = None, loiter_seq: int | None = None) -> PathStage:
            z_m = position_m(loiter, self.mission.home, flyer.frame)[2] if loiter is not None else corners[-1][2]
            radius_m = loiter.param3 if loiter is not None else 0.0
            way = Way(tuple(corners), tuple(seqs), tuple(wanted), radius_m, z_m)
            reference = reference_of(way, flyer.airframe, flyer.wind_m_s, *lead_in)
            lands = items[seqs[-1]].command == Command.NAV_LAND
            return PathStage(reference, marks, after, takeoff=takeoff, loiter_seq=loiter_seq, lands=lands)

        def add(seq: int, place: Vector, speed: Speed, at: Mark) -> None:
            if start.course is not None and len(corners) == 1:
                lead_in.append(self._lead_in(start, place, speed))
                corners[0] = (*end_of(lead_in[0]), start.position_m[2])
            corners.append(place)
            seqs.append(seq)
            wanted.append(speed)
            marks.append(at)

        while mark.seq < len(items) and len(corners) <= LONGEST_PATH:
            seq, item = mark.seq, items[mark.seq]
            after = mark._replace(seq=seq + 1)
            command = item.command
            if command == Command.DO_CHANGE_SPEED:
                mark = after._replace(speed=changed_speed(item, mark.speed, flyer.airframe))
            elif command == Command.DO_JUMP:
                mark = self._follow(mark, item, jumped) if jumping else after
            elif command == Command.DO_LAND_START:
                mark = after
            elif command == Command.NAV_TAKEOFF:
                if start.course is not None and start.position_m[2] >= self._takeoff_z_m(item):
                    reached.append(seq)
                    mark = after
                elif len(corners) > 1:
                    return path(mark), reached, mark
                elif start.course is None and self._waypoint_follows(after, jumping=jumping):
                    takeoff = TakeoffItem(seq, self._takeoff_z_m(item))
                    mark = after
                else:
                    return self._climb_out(mark, item, start), reached, after
            elif command == Command.NAV_RETURN_TO_LAUNCH or command in COUNTED:
                if len(corners) > 1:
                    return path(mark), reached, mark
                if start.course is None:
                    return self._climb_out(mark, None, start), reached, mark
                return self._circle(mark, item, start), reached, after
            else:
                place = self._place_m(seq, item, corners[-1])
                if command == Command.NAV_LOITER_UNLIM:
                    if math.dist(place[:2], corners[-1][:2]) >= SAME_PLACE_M:
                        if self._too_sharp(corners, place):
                            return path(mark), reached, mark
                        add(seq, place, mark.speed, mark)
                    if len(corners) > 1 and self._is_way(corners):
                        return path(after, loiter=item, loiter_seq=seq), reached, after
                    if start.course is None:
                        raise _nowhere()
                    return self._circle(mark, item, start), reached, after
                if command == Command.NAV_LAND and len(corners) == 1:
                    if start.course is None:
                        return self._climb_out(mark, None, start), reached, mark
                    if (stage := self._to_approach(mark, start, add)) is not None:
                        return stage, reached, mark
                if self._too_sharp(corners, place):
                    return path(mark), reached, mark
                if command == Command.NAV_LAND:
                    add(seq, place, Speed(approach_airspeed_m_s(flyer.airframe), over_ground=False), mark)
                    return path(after), reached, after
                near = math.dist(place[:2], start.position_m[:2]) < ARRIVED_M
                if start.course is not None and len(corners) == 1 and near and not reached:
                    reached.append(seq)
                else:
                    add(seq, place, mark.speed, mark)
                jumped.clear()
                mark = after
        if len(corners) == 1:
            if start.course is None and self.flies:
                raise _nowhere()
            return None, reached, mark
        ends = mark.seq >= len(items)
        return path(mark, loiter_seq=seqs[-1] if ends else None), reached, mark

    def _lead_in(self, start: Start, place: Vector, speed: Speed) -> Arc:
        """The turn on to the first leg, tighter when it would end just where that leg does."""
        flyer, (x, y, _) = self._flyer, start.position_m
        airspeed = min(max(flyer.airframe.airspeed_cruise_m_s, speed.m_s), flyer.airframe.airspeed_max_m_s)
        radius_m = fillet_radius_m(airspeed + math.hypot(*flyer.wind_m_s))
        course = start.course or 0.0
        arc = turn_towards(x, y, course, place[:2], radius_m)
        if math.dist(end_of(arc), place[:2]) <= SAME_PLACE_M:
            return turn_towards(x, y, course, place[:2], radius_m / 2.0)
        return arc

    def _check(self, start_m: Vector) -> Stage:
        """Build every stage once, jumps not followed; returns the first, jumps followed."""
        first, _, mark = self.stage(self.first(), Start(start_m))
        assert first is not None
        start = self._end_of(first, Start(start_m))
        if any(item.command == Command.DO_JUMP for item in self.mission):
            mark, start = self.first(), Start(start_m)
        legs = 0
        while mark.seq < len(self.mission) and legs <= 2 * len(self.mission):
            stage, _, mark = self.stage(mark, start, jumping=False)
            start = self._end_of(stage, start)
            legs += 1
        return first

    def _end_of(self, stage: Stage | None, start: Start) -> Start:
        """Where a stage ends, more or less."""
        if isinstance(stage, PathStage):
            return Start(stage.reference.target_m, stage.reference.target_heading)
        if isinstance(stage, CircleStage):
            loiter = stage.loiter
            return Start((loiter.x_m + loiter.radius_m, loiter.y_m, loiter.z_m), 0.5 * math.pi * loiter.turn)
        if isinstance(stage, ClimbOutStage):
            x, y, _ = start.position_m
            return Start((x, y, stage.z_m), stage.course)
        return start

    def _check_jump(self, seq: int, item: MissionItem) -> None:
        target, last = item.param1, len(self.mission) - 1
        if not (1 <= target <= last and target == int(target) and target != seq):
            raise InputError(f"mission item {seq}: DO_JUMP to item {target:g}; there are 1 to {last}, itself excluded")
        if not (item.param2 >= -1 and item.param2 == math.floor(item.param2)):
            raise InputError(f"mission item {seq}: DO_JUMP {item.param2:g} times; -1 means for ever")

    def _before_landing(self, seq: int) -> int:
        """The item that the landing `seq` comes from."""
        before = next((n for n in range(seq - 1, 0, -1) if self.mission[n].command in PLACES), 0)
        if before == 0 or self.mission[before].command == Command.NAV_LAND:
            raise InputError(f"mission item {seq}: LAND needs a waypoint before it to come from")
        return before

    def _check_landing(self, seq: int) -> None:
        flyer, before = self._flyer, self.place_m(self._before_landing(seq))
        touchdown = self._place_m(seq, self.mission[seq], before)
        check_approach(seq, before, touchdown, flyer.airframe, flyer.terrain, math.hypot(*flyer.wind_m_s))

    def _follow(self, mark: Mark, jump: MissionItem, jumped: set[int]) -> Mark:
        seq = mark.seq
        if seq in jumped or not (jump.param2 == -1 or mark.times_jumped(seq) < jump.param2):
            return mark._replace(seq=seq + 1)
        jumped.add(seq)
        return mark.jumping(seq, int(jump.param1)) if jump.param2 != -1 else mark._replace(seq=int(jump.param1))

    def _waypoint_follows(self, mark: Mark, *, jumping: bool) -> bool:
        """Whether the first item with a place, after a take-off, is one that a path goes through."""
        jumped: set[int] = set()
        while mark.seq < len(self.mission):
            item = self.mission[mark.seq]
            if item.command in FLOWN:
                return item.command in (Command.NAV_WAYPOINT, Command.NAV_LOITER_UNLIM)
            if item.command == Command.DO_JUMP and jumping:
                mark = self._follow(mark, item, jumped)
            else:
                mark = mark._replace(seq=mark.seq + 1)
        return False

    def _takeoff_z_m(self, item: MissionItem) -> float:
        return position_m(item, self.mission.home, self._flyer.frame)[2]

    def _climb_out(self, mark: Mark, takeoff: MissionItem | None, start: Start) -> ClimbOutStage:
        """Towards the next place, up to the take-off's altitude."""
        x, y, z = start.position_m
        z_m = self._takeoff_z_m(takeoff) if takeoff is not None else z + LOWEST_CLIMB_OUT_M
        course = start.course
        after = mark if takeoff is None else mark._replace(seq=mark.seq + 1)
        if course is None:
            course = 0.0
            for seq in range(after.seq, len(self.mission)):
                if self.mission[seq].command in PLACES:
                    place = self._place_m(seq, self.mission[seq], start.position_m)
                    course = math.atan2(place[1] - y, place[0] - x)
                    break
        seq = mark.seq if takeoff is not None else 0
        return ClimbOutStage(course, max(z_m, z + LOWEST_CLIMB_OUT_M), seq=seq, mark=mark, after=after)

    def _circle(self, mark: Mark, item: MissionItem, start: Start) -> CircleStage:
        """The loiter of an item."""
        after, flyer = mark._replace(seq=mark.seq + 1), self._flyer
        if item.command == Command.NAV_RETURN_TO_LAUNCH:
            home = flyer.returning(start.position_m)
            return CircleStage(home.loiter, seq=mark.seq, mark=mark, guard=home.guard, complete=True)
        place = self._place_m(mark.seq, item, start.position_m)
        # LOITER_TO_ALT has its radius in param2.
        asked = item.param2 if item.command == Command.NAV_LOITER_TO_ALT else item.param3
        until = {
            Command.NAV_LOITER_TIME: Until(time_s=max(item.param1, 0.0)),
            Command.NAV_LOITER_TURNS: Until(turns=max(item.param1, 0.0)),
            Command.NAV_LOITER_TO_ALT: Until(altitude=True),
        }.get(Command(item.command), Until())
        return CircleStage(
            flyer.loiter(place, asked if math.isfinite(asked) else 0.0),
            until,
            seq=mark.seq,
            airspeed_m_s=flyer.airframe.airspeed_cruise_m_s if mark.speed.over_ground else mark.speed.m_s,
            mark=mark,
            after=after,
            complete=item.command == Command.NAV_LOITER_UNLIM,
        )

    def _to_approach(
        self, mark: Mark, start: Start, add: Callable[[int, Vector, Speed, Mark], None]
    ) -> CircleStage | None:
        """Before a landing that a stage begins with: through the waypoint before it, or down the loiter before it."""
        before = self._before_landing(mark.seq)
        item, (x, y, z) = self.mission[before], self.place_m(before)
        here_x, here_y, here_z = start.position_m
        if item.command in COUNTED:
            circle = self._circle(mark._replace(seq=before), item, start)
            away_m = math.hypot(here_x - x, here_y - y)
            if away_m <= SETTLED_RADII * circle.loiter.radius_m and abs(here_z - z) <= SETTLED_Z_M:
                return None
            descend = Until(altitude=True)
            return CircleStage(
                circle.loiter, descend, seq=mark.seq, airspeed_m_s=circle.airspeed_m_s, mark=mark, after=mark
            )
        if math.hypot(here_x - x, here_y - y) >= ARRIVED_M:
            add(before, (x, y, z), mark.speed, mark)
        return None

    def _place_m(self, seq: int, item: MissionItem, before_m: Vector) -> Vector:
        """The place of an item; of a LAND, on the ground."""
        flyer = self._flyer
        place = place_m(seq, item, self.mission.home, flyer.frame, before_m)
        if item.command != Command.NAV_LAND:
            return place
        x, y, _ = place
        return x, y, ground_height_m(x, y, flyer.terrain)

    @staticmethod
    def _is_way(corners: list[Vector]) -> bool:
        return max(math.dist(corner[:2], corners[0][:2]) for corner in corners) >= SAME_PLACE_M

    @staticmethod
    def _too_sharp(corners: list[Vector], place: Vector) -> bool:
        """Whether the turn at the path's last corner, on to a place, is sharper than an arc there could be flown."""
        apart = [place]
        for corner in reversed(corners):
            if math.dist(corner[:2], apart[-1][:2]) >= SHORTEST_LEG_M:
                apart.append(corner)
            if len(apart) == 3:
                (x2, y2, _), (x1, y1, _), (x0, y0, _) = apart
                turn = math.atan2(y2 - y1, x2 - x1) - math.atan2(y1 - y0, x1 - x0)
                turn = abs(math.remainder(turn, 2.0 * math.pi))
                room_m = min(math.hypot(x2 - x1, y2 - y1), math.hypot(x1 - x0, y1 - y0))
                tight = turn > ANY_ARC_TURN and room_m < TIGHTEST_ARC_M * math.tan(0.5 * turn)
                return tight or turn > SHARPEST_TURN - 1e-6
        return False


def _nowhere() -> InputError:
    return InputError("mission: no waypoint away from home; add a NAV_WAYPOINT")
