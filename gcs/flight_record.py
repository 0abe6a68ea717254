"""What a flight was and what became of it, as far as the truth does not tell: figures of merit are made of both."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from gcs.truth import FloatArray
from missions.reassignment import Loss, Reassigned
from sitl.avoidance.yielding import Yieldings
from sitl.config import Arm
from sitl.formation.graph import EdgeChange
from sitl.formation.link_report import LinkReport


@dataclass(frozen=True)
class Event:
    """Something that happened, at a simulated time; `sysid` is None when it happened to no single vehicle."""

    t_s: float
    sysid: int | None
    what: str


LOST = "lost: "
"""Begins what of an event tells that a vehicle was lost, and why."""
INTERVENTION = "console: "
"""Begins what of an event tells that somebody who steered has done it: no seed makes it happen again."""
DISTURBANCE = f"{INTERVENTION}corrections "
"""The same, of all corrections."""


@dataclass(frozen=True)
class Timing:
    """How long things took: wall time, but for `flight_sim_s`. A rehearsal starts and uploads nothing: None.

    Attributes:
        compile_s, plan_s: compilation, and planning without it.
        startup_s: from the launch to the last endpoint's first heartbeat.
        upload_s: all missions, read-back included.
        flight_wall_s, flight_sim_s: from the release of the clock to the end.
        real_time_factor: flight_sim_s / flight_wall_s.
    """

    compile_s: float
    plan_s: float
    startup_s: float | None
    upload_s: float | None
    flight_wall_s: float
    flight_sim_s: float
    real_time_factor: float


@dataclass(frozen=True)
class FlightRecord:
    """One flight of a plan.

    Attributes:
        seed: of the gusts, and of the plan unless a rehearsal chose another.
        delay_s: effective delay of the corrections.
        arm: how much of the formation law was on.
        items_uploaded, items_verified: mission items by sysid: sent, and read back equal; none in a rehearsal.
        timing: how long things took.
        events: in order of time.
        lost: when a vehicle was lost, by sysid; simulated time in seconds.
        delay_margin_s: the `aircraft` margin of the formation; infinite when any delay is stable.
        edges: changes of who makes use of whose corrections; a lost vehicle's own are not known.
        yieldings: who gave way to whom; a lost vehicle's own are not known.
        reassigned: who took whose place.
        losses: that were not scheduled, as the vehicles have agreed on them, where places are reassigned.
        links: what came of the links, as their receivers counted; a lost vehicle's own are not known.
        shifts: by sysid: (n_tick, 2) rows of seconds that the schedule had been slowed and hurried; empty without a
            swarm clock.
        real_time: whether the clock was the wall's; in lockstep otherwise.
        behind_s: wall time by which a vehicle fell behind that clock, at the most.
    """

    seed: int
    delay_s: float
    arm: Arm
    items_uploaded: Mapping[int, int]
    items_verified: Mapping[int, int]
    timing: Timing
    events: tuple[Event, ...]
    lost: Mapping[int, float]
    delay_margin_s: float
    edges: tuple[EdgeChange, ...] = ()
    yieldings: Yieldings = field(default_factory=dict)
    reassigned: Reassigned = field(default_factory=Reassigned)
    losses: tuple[Loss, ...] = ()
    links: tuple[LinkReport, ...] = ()
    shifts: Mapping[int, FloatArray] = field(default_factory=dict)
    real_time: bool = False
    behind_s: float = 0.0
