"""Whether a vehicle is on the ground, in the air, or on the way from one to the other."""

from sitl.pilot import Pilot, Stage
from sitl.snapshot import LandedState
from sitl.stages.path import PathStage
from sitl.stages.straight import ClimbOutStage, GlideStage


def is_landing(stage: Stage | None) -> bool:
    """Whether a stage comes down to the ground."""
    return isinstance(stage, GlideStage) or (isinstance(stage, PathStage) and stage.on_final)


def landed_state(pilot: Pilot) -> LandedState:
    """Of what the pilot flies now."""
    stage = pilot.stage
    if not pilot.airborne:
        return LandedState.ON_GROUND
    if is_landing(stage):
        return LandedState.LANDING
    taking_off = isinstance(stage, ClimbOutStage) or (isinstance(stage, PathStage) and stage.taking_off)
    return LandedState.TAKING_OFF if taking_off else LandedState.IN_AIR
