"""The tables of the network between vehicles, and of what is to fail in flight. Times in seconds, simulated."""

from typing import Annotated, Literal, Self

from pydantic import ConfigDict, Field, StrictBool, model_validator

from missions.scenario.keys import Fraction, Keys, NotNegative, Number, Positive

Sysid = Annotated[int, Field(strict=True, ge=1, le=250)]
Probability = Annotated[Number, Field(ge=0, lt=1)]
Delay = Annotated[NotNegative, Field(le=60)]


class FormationModel(Keys):
    """Who hears whom, with what delay, and the gains of the law (15)."""

    graph: Literal["ring", "line", "star", "complete"] | tuple[tuple[Sysid, Sysid], ...] = "ring"
    """A name, or pairs of sysids that hear each other."""
    delay_s: Delay = 0.2
    k1: NotNegative = 0.2
    k2: NotNegative = 0.8
    k3: NotNegative = 0.4
    k0: NotNegative = 0.01
    pinned: tuple[Sysid, ...] | None = None
    """Vehicles with h_p = 1, the others have 0 and no k0; all unless given."""
    swarm_clock: StrictBool = False
    """Whether the schedule slows down, or hurries, for all when one vehicle can go no faster, or slower."""
    stale_s: Positive = 2.0
    """A sample that is older than its delay and jitter by so much counts no more: the edge is dropped."""
    avoidance: Annotated[bool, Field(strict=True)] = False
    """Vehicles that will come nearer than `limits.separation_m` give way, beyond the plan."""

    reassign: StrictBool = False
    """Whether those who are left close the gap that a lost vehicle leaves, each flying to the place that an assignment
    by squared distances gives it."""

    def is_pinned(self, sysid: int) -> bool:
        """Whether h_p is 1."""
        return self.pinned is None or sysid in self.pinned


class BurstModel(Keys):
    """Losses that come together (Gilbert and Elliott)."""

    every_s: Positive
    """Mean time from the end of one to the beginning of the next."""
    length_s: Positive
    """Mean length."""
    loss: Fraction = 1.0
    """Probability a sample, while one lasts."""


class ChannelModel(Keys):
    """What happens to samples on every link, beside `formation.delay_s`."""

    jitter_s: Delay = 0.0
    """Added to the delay, evenly distributed from 0 to this."""
    loss: Probability = 0.0
    """Probability a sample."""
    bursts: BurstModel | None = None


class LinkModel(Keys):
    """One direction of one link, where it differs from the others."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_by_name=True)

    sender: Annotated[Sysid, Field(alias="from")]
    receiver: Annotated[Sysid, Field(alias="to")]
    delay_s: Delay | None = None
    jitter_s: Delay | None = None
    loss: Probability | None = None
    bursts: BurstModel | None = None


class FailureModel(Keys):
    """Something that fails."""

    what: Literal["kill", "freeze", "silence", "split"]
    """`kill`: vehicles are gone, for ever. `freeze`: what computes their formation law hangs; a plain autopilot flies
    on, and they neither say nor hear anything. `silence`: they are not heard and hear nothing. `split`: groups of
    vehicles that do not hear each other."""
    at_s: NotNegative
    for_s: Positive | None = None
    """How long; not for a kill."""
    vehicles: tuple[Sysid, ...] = ()
    """Of a silence, none means all."""
    groups: tuple[tuple[Sysid, ...], ...] = ()
    """Of a split; vehicles in no group are one more."""

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.for_s is None) != (self.what == "kill"):
            raise ValueError("a kill is for ever, leave for_s out" if self.for_s else f"a {self.what} needs for_s")
        if self.what == "split" and (not self.groups or self.vehicles):
            raise ValueError("a split needs groups, and no vehicles")
        if self.what != "split" and self.groups:
            raise ValueError(f"a {self.what} has no groups; name vehicles")
        if self.what in ("kill", "freeze") and not self.vehicles:
            raise ValueError(f"a {self.what} needs vehicles")
        return self
