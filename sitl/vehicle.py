"""One simulated vehicle: what the services may ask of it, and what the clock does with it."""

import math
import threading
from collections.abc import Callable, Mapping, Sequence, Set

from missions.airframe import thrust_max_n
from missions.errors import InputError
from missions.fence import parse_fence
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.reassignment import Loss
from sitl.avoidance.avoider import Heard
from sitl.avoidance.intent import Intent
from sitl.avoidance.yielding import Yielding
from sitl.captain import Captain
from sitl.config import VehicleConfig
from sitl.events import WARNING, ItemReached, StatusText
from sitl.failsafes import Failsafes
from sitl.fence_watch import FenceAreas
from sitl.flight import ground_velocity
from sitl.formation.correction import Correction
from sitl.formation.disturbance import Disturbance
from sitl.formation.link_report import LinkReport, mean_delay_s
from sitl.formation.link_state import LinkState
from sitl.homing import check_rally
from sitl.landed_state import landed_state
from sitl.lookout import Lookout
from sitl.modes import Mode
from sitl.parameters import Parameters, arduplane_parameters
from sitl.pilot import Phase
from sitl.places import Places
from sitl.plan_memory import keep_plan, recall_plan
from sitl.prearm import reason_not_to_arm
from sitl.snapshot import Snapshot
from sitl.stages.circle import CircleStage
from sitl.stages.path import PathStage
from sitl.store import Store
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter

_TOTALS = {PlanType.FENCE: "FENCE_TOTAL", PlanType.RALLY: "RALLY_TOTAL"}


class Vehicle:
    """A simulated vehicle.

    The clock's thread calls `observe` and `advance` in turn, once a tick each; any thread may ask the rest while it
    holds `lock`. The commands return None when done, else the reason why not.

    Args:
        config: what it is told at its start.
        truth: takes its state at each tick.
        store: keeps plans and parameters over restarts.

    Attributes:
        links: what has come of the links to it, as far as it is known.
    """

    def __init__(self, config: VehicleConfig, truth: TruthWriter, store: Store | None = None) -> None:
        self.lock = threading.RLock()
        self.links: tuple[LinkReport, ...] = ()
        self._config = config
        self._truth = truth
        self._store = store or Store()
        self.parameters = Parameters(arduplane_parameters(config.sysid, config.airframe), self._store)
        self._events: list[ItemReached | StatusText] = []
        self._captain = Captain(config, self.parameters, self._report)
        self._pilot = self._captain.pilot
        self._lookout = Lookout(self._pilot, config, self._report)
        self._places = Places(self._captain, config, self._report) if config.reassign is not None else None
        self._failsafes = Failsafes(self._captain, config, self.parameters)
        self._plans: dict[PlanType, tuple[MissionItem, ...]] = {PlanType.FENCE: (), PlanType.RALLY: ()}
        self._recall()

    # What the services may ask.

    @property
    def sysid(self) -> int:
        """MAVLink system id; to its neighbours it stays what it was configured as."""
        return int(self.parameters["MAV_SYSID"])

    @property
    def tick(self) -> int:
        """Simulated time."""
        return self._pilot.tick

    @tick.setter
    def tick(self, tick: int) -> None:
        self._pilot.tick = tick

    @property
    def home(self) -> MissionItem:
        """Item 0 of every mission."""
        return self._captain.home

    @property
    def mission(self) -> Mission:
        """The mission held."""
        return self._captain.itinerary.mission

    @property
    def airborne(self) -> bool:
        """Whether it is in the air."""
        return self._pilot.airborne

    def items(self, plan: PlanType) -> tuple[MissionItem, ...]:
        """The plan held of one type; a mission has at least home."""
        return self.mission.items if plan == PlanType.MISSION else self._plans[plan]

    def load(self, plan: PlanType, items: Sequence[MissionItem]) -> None:
        """Keep a plan and take it over; item 0 of a mission is replaced by home.

        Raises:
            InputError: it cannot be flown, is being flown, or could not be kept; the message says why, and the old one
                stays.
        """
        held = tuple(items)
        if plan == PlanType.MISSION:
            held = (self.home, *held[1:])
            if self.airborne and self._captain.mode == Mode.AUTO:
                raise InputError("mission: it is being flown; change to LOITER first")
        take = self._checked(plan, held)
        keep_plan(self._store, plan, held)
        take()

    def set_mode(self, mode: Mode) -> str | None:
        """Change the mode."""
        return self._captain.set_mode(mode)

    def start_mission(self) -> str | None:
        """Fly the mission from its first item, if armed."""
        return self._captain.start_mission()

    def set_current(self, seq: int) -> str | None:
        """Go on with this item of the mission, now or when AUTO is next; 0 and 1 are its beginning."""
        return self._captain.set_current(seq)

    def change_speed(self, speed_m_s: float, *, over_ground: bool) -> str | None:
        """Fly at another speed from now on, until the mode changes; -2 for the default."""
        return self._captain.change_speed(speed_m_s, over_ground=over_ground)

    def take_off(self, altitude_m: float) -> str | None:
        """Take off in mode TAKEOFF to an altitude above home."""
        return self._captain.take_off(altitude_m)

    def reposition(self, item: MissionItem) -> str | None:
        """Fly to a place in mode GUIDED and circle there."""
        return self._captain.reposition(item)

    def set_home(self, home: MissionItem | None) -> str | None:
        """Change home; None for where it is now, in the air the ground below."""
        return self._captain.set_home(home)

    def enable_fence(self, enabled: bool) -> str | None:
        """Heed the fence, or not: sets FENCE_ENABLE."""
        if enabled and (missing := self._failsafes.fence.missing()) is not None:
            return missing
        try:
            self.parameters.set("FENCE_ENABLE", float(enabled))
        except InputError as error:
            return str(error)
        return None

    def hear_station(self, now_s: float) -> None:
        """The station has been heard."""
        self._failsafes.hear_station(now_s)

    def watch_station(self, now_s: float) -> None:
        """Wall time has passed: if the station has been silent for too long in flight, do what FS_LONG_ACTN says."""
        self._failsafes.watch_station(now_s)

    def prearm(self) -> str | None:
        """Why it could not be armed now."""
        return reason_not_to_arm(
            self._captain.mode,
            flies=self._captain.itinerary.flies,
            parameters=self.parameters,
            fence=self._failsafes.fence,
            home_m=self._captain.home_m,
            here_m=self._pilot.start.position_m,
            terrain=self._config.terrain,
        )

    def arm(self, *, force: bool = False) -> str | None:
        """Arm; in the air, by force, that starts the engine again, and it circles."""
        captain = self._captain
        if captain.armed:
            return None
        if self._pilot.phase == Phase.ROLLING:
            return "Still rolling"
        if self.airborne:
            if not force:
                return "Gliding with the engine off: arm by force"
            captain.armed = True
            captain.enter(Mode.LOITER)
            captain.circle_here()
            return None
        if not force and (reason := self.prearm()) is not None:
            return reason
        captain.armed = True
        return None

    def disarm(self, *, force: bool = False) -> str | None:
        """Disarm; by force in the air too, where it then glides down straight ahead."""
        if self.airborne and self._captain.armed:
            if not force:
                return "flying"
            self._captain.stop_engine()
        self._captain.armed = False
        return None

    def drain_events(self) -> list[ItemReached | StatusText]:
        """What has happened since it was last asked."""
        events, self._events = self._events, []
        return events

    def report(self, text: StatusText) -> None:
        """Tell the stations something."""
        self._events.append(text)

    def disturb(self, delay_ticks: int, loss: float, from_tick: int | None) -> int:
        """Add delay and loss to all its links from a tick on, until the next time; None for the tick to come.

        Returns:
            The tick from which it counts.

        Raises:
            ValueError: that tick is over.
        """
        if from_tick is None:
            from_tick = self.tick
        if from_tick < self.tick:
            raise ValueError(f"from_tick: {from_tick} is over, it is {self.tick}; choose a later one")
        self._pilot.formation.disturb(Disturbance(delay_ticks, loss, from_tick))
        return from_tick

    @property
    def disturbance(self) -> Disturbance:
        """What is in force."""
        return self._pilot.formation.disturbance

    def link_states(self) -> tuple[LinkState, ...]:
        """How its links stand, in order of the neighbours' sysids."""
        return self._pilot.formation.link_states(self.tick - 1)

    def lose(self, lost: Set[int]) -> Set[int]:
        """Fly on without these vehicles; returns the neighbours that are left, new ones among them."""
        self._pilot.formation.lose(lost)
        return self._pilot.formation.neighbours_at(self.tick)

    def count_lost(self, loss: Loss) -> None:
        """All have agreed on a loss: its place may be given to another."""
        if self._places is not None:
            self._places.lose(loss)

    def losses(self) -> tuple[Loss, ...]:
        """Those that all have agreed on so far."""
        return tuple(self._places.unforeseen) if self._places is not None else ()

    def edges(self) -> tuple[tuple[int, int, bool], ...]:
        """(tick, neighbour, whether its edge counted from then on), of each change so far."""
        return tuple(self._pilot.formation.edges)

    def yieldings(self) -> tuple[Yielding, ...]:
        """Who was given way to so far."""
        return self._lookout.yieldings()

    def snapshot(self) -> Snapshot:
        """What there is to know at this tick."""
        captain, pilot, fence, flying = self._captain, self._pilot, self._failsafes.fence, self.airborne
        config = self._config
        flight, errors, stage = pilot.flight, pilot.errors, pilot.stage
        air = flight.air
        thrust_fraction = flight.controls.thrust / thrust_max_n(air.V, config.airframe) if flying else 0.0
        rolling = (air.V * math.cos(air.chi), air.V * math.sin(air.chi), 0.0)
        distance_m = 0.0
        if isinstance(stage, PathStage):
            distance_m = stage.distance_m(flight.point.s_m)
        elif isinstance(stage, CircleStage) and not stage.complete:
            distance_m = stage.distance_m(flight)
        return Snapshot(
            time_s=self.tick * TICK_S,
            mode=captain.mode,
            armed=captain.armed,
            airborne=flying,
            position_m=(air.x, air.y, air.h),
            ground_velocity_m_s=ground_velocity(flight) if flying else rolling,
            airspeed_m_s=air.V,
            climb_angle=air.gamma,
            heading=air.chi,
            bank=flight.controls.bank,
            thrust_fraction=min(thrust_fraction, 1.0),
            wind_m_s=flight.wind,
            airspeed_wanted_m_s=pilot.airspeed_wanted_m_s,
            current_seq=captain.current_seq if flying else 0,
            mission_complete=captain.complete,
            cross_track_m=errors.across if errors else 0.0,
            altitude_error_m=errors.above if errors else 0.0,
            along_track_m=errors.along if errors else 0.0,
            distance_to_waypoint_m=distance_m,
            landed=landed_state(captain.pilot),
            home_m=captain.home_m,
            ready=captain.armed or flying or self.prearm() is None,
            failsafe=self._failsafes.active,
            in_formation=pilot.in_formation,
            schedule_shift_s=pilot.shifts.hurried.sum_s - pilot.shifts.slowed.sum_s if config.swarm_clock else None,
            formation_delay_s=mean_delay_s(self.links) or config.network.channel.delay_ticks * TICK_S,
            late_samples=sum(link.late for link in self.links) if config.real_time else None,
            lost_samples=sum(link.lost for link in self.links) if config.real_time else None,
            fence_enabled=fence.enabled,
            breach_status=fence.breached,
            breach_count=fence.count,
            breach_type=fence.last,
            breach_time_s=fence.last_time_s,
        )

    # What the clock does, once a tick each.

    def observe(self) -> Correction:
        """Begin a tick: launch if it is time, feel the wind, find the place on the path, keep the truth.

        Returns:
            The own deviation at this tick, for the neighbours.
        """
        pilot = self._pilot
        if pilot.phase is Phase.FLYING:
            pilot.feel()
        elif self._captain.armed and pilot.phase is Phase.PARKED:
            self._captain.launch()
        if self._places is not None:
            self._places.begin()
        self._lookout.begin()
        own = pilot.observe()
        self._truth.write(pilot.flight.air, pilot.shifts)
        return own

    def intent(self) -> Intent:
        """What it intends as of this tick, for all others; after `observe`, where vehicles give way."""
        return self._lookout.intent()

    def learn(self, heard: Heard, lost: Set[int]) -> None:
        """Take in what the others intend, and decide who is given way to from the next tick on.

        Args:
            heard: by vehicle, what has come of it.
            lost: vehicles that are no more.
        """
        self._lookout.learn(heard, lost)

    def advance(self, heard: Mapping[int, Correction]) -> None:
        """End a tick: decide, move, and note what has been reached.

        Args:
            heard: by neighbour, its deviation of as many ticks ago as its channel delays it; who said nothing is left
                out.
        """
        pilot = self._pilot
        pilot.hear(heard)
        was = pilot.phase
        if was is not Phase.PARKED:
            pilot.advance()
            if pilot.reached:
                self._events += [ItemReached(seq) for seq in pilot.reached]
                pilot.reached.clear()
            if pilot.phase is not was:
                self._failsafes.rest()
                self._captain.note_ground(was)
            elif was is Phase.FLYING:
                self._captain.note()
                self._failsafes.heed_fence()
        pilot.tick += 1

    def _checked(self, plan: PlanType, items: tuple[MissionItem, ...]) -> Callable[[], None]:
        """What takes over a plan. Raises InputError when it cannot be flown."""
        if plan == PlanType.MISSION:
            itinerary = self._captain.planned(Mission(items))
            return lambda: self._captain.adopt(itinerary)
        areas = FenceAreas(parse_fence(items), self._config.frame) if plan == PlanType.FENCE else None
        if plan == PlanType.RALLY:
            check_rally(items, self._config.frame)

        def take() -> None:
            self._plans[plan] = items
            self.parameters.tell(_TOTALS[plan], len(items))
            if plan == PlanType.RALLY:
                self._captain.rally = items
            if areas is not None:
                self._failsafes.fence.areas = areas

        return take

    def _recall(self) -> None:
        """The plans that were kept; without those that are damaged or can no longer be flown."""
        self.parameters.tell("MIS_TOTAL", 1)
        for plan in (PlanType.MISSION, PlanType.FENCE, PlanType.RALLY):
            try:
                if (items := recall_plan(self._store, plan)) is not None:
                    held = (self.home, *items[1:]) if plan == PlanType.MISSION else items
                    self._checked(plan, held)()
            except InputError as error:
                self._report(StatusText(WARNING, f"Kept {plan.name.lower()} not used: {error}"))

    def _report(self, event: ItemReached | StatusText) -> None:
        self._events.append(event)
