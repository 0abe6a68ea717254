"""Whose place a vehicle flies: it knows who is lost, finds what that leads to, and makes its move when that is due."""

from collections.abc import Callable, Iterable

import numpy as np

from missions.reassignment import Loss, Move, Reassign, Reassigned
from missions.reference import Reference
from missions.reference.reference import SCHEDULE_WINDOW_S
from sitl.captain import Captain
from sitl.config import VehicleConfig
from sitl.events import NOTICE, WARNING, StatusText
from sitl.formation.network import Network
from sitl.modes import Mode
from sitl.stages.path import PathStage
from sitl.ticks import TICK_S

SAME_M = 0.01
"""Two references agree that are so near to each other."""


def scheduled_losses(network: Network) -> tuple[Loss, ...]:
    """The losses that are scheduled, at the ticks from which on they are known: those at which the graph is mended."""
    losses, known = [], frozenset[int]()
    for tick, gone in network.epochs[1:]:
        losses.append(Loss(tick * TICK_S, gone - known))
        known = gone
    return tuple(losses)


def what_losses_lead_to(vehicle: VehicleConfig, unforeseen: Iterable[Loss] = ()) -> Reassigned:
    """What losses lead to in a vehicle's swarm: those that are scheduled, and others."""
    if vehicle.reassign is None:
        return Reassigned()
    losses = [*scheduled_losses(vehicle.network), *unforeseen]
    return vehicle.reassign(sorted(losses, key=lambda loss: loss.t_s))


def from_tick(move: Move) -> int:
    """The tick from which on a move's reference holds."""
    return round(move.from_s / TICK_S)


class Places:
    """Has a vehicle take other vehicles' places.

    Args:
        captain: of the vehicle.
        config: of the vehicle; `reassign` is set.
        report: told what it does.

    Attributes:
        unforeseen: the losses that were not scheduled, as agreed.
    """

    def __init__(self, captain: Captain, config: VehicleConfig, report: Callable[[StatusText], None]) -> None:
        assert config.reassign is not None
        self._captain = captain
        self._sysid = config.sysid
        self._reassign: Reassign = config.reassign
        self._report = report
        self.unforeseen: list[Loss] = []
        self._pending = list(scheduled_losses(config.network))
        self._known: list[Loss] = []
        self._moves: list[Move] = []
        self._made = 0

    def lose(self, loss: Loss) -> None:
        """All have agreed on a loss that no schedule has foreseen."""
        self.unforeseen.append(loss)
        self._pending = sorted([*self._pending, loss], key=lambda one: one.t_s)

    def begin(self) -> None:
        """Begin a tick: count who is lost, and make the move that is due."""
        tick = self._captain.pilot.tick
        if self._pending and self._pending[0].t_s <= tick * TICK_S:
            while self._pending and self._pending[0].t_s <= tick * TICK_S:
                self._known.append(self._pending.pop(0))
            self._moves = list(self._reassign(self._known).of(self._sysid))
        if self._made < len(self._moves) and from_tick(move := self._moves[self._made]) <= tick:
            self._made += 1
            self._make(move)

    def _make(self, move: Move) -> None:
        """Fly on to another vehicle's place and take over its mission, if the own one is flown as planned."""
        captain, pilot = self._captain, self._captain.pilot
        stage = pilot.stage
        if not (captain.mode == Mode.AUTO and isinstance(stage, PathStage) and self._continues(stage, move)):
            self._report(StatusText(WARNING, f"Not flying as planned: does not take the place of UAV {move.place}"))
            return
        itinerary = captain.planned(move.mission.with_home(captain.home))
        assert isinstance(itinerary.first_stage, PathStage)
        captain.adopt(itinerary, stage.onto(move.reference, itinerary.first_stage, pilot.flight.point.s_m))
        text = f"Takes the place of UAV {move.place} from {move.start_s:.0f} s to {move.end_s:.0f} s"
        self._report(StatusText(NOTICE, text))

    def _continues(self, stage: PathStage, move: Move) -> bool:
        """Whether a move begins with what is flown."""
        pilot = self._captain.pilot
        t_s = np.linspace(pilot.tick * TICK_S, 0.5 * (pilot.tick * TICK_S + move.start_s), 8)
        planned = stage.started_tick == 0 and pilot.commanded is None and t_s[0] < move.start_s - SCHEDULE_WINDOW_S
        return planned and _agree(stage.reference, move.reference, t_s)


def _agree(one: Reference, other: Reference, t_s: np.ndarray) -> bool:
    """Whether two references have the same positions at times (n,)."""
    return bool(np.abs(one.positions(t_s) - other.positions(t_s)).max() < SAME_M)
