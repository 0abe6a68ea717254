"""What an endpoint is told when it starts. It learns its plan only as a mission, over MAVLink; where places are
reassigned it knows those of all, to find what a loss leads to."""

from dataclasses import dataclass
from typing import Literal

from missions.airframe import Airframe
from missions.environment import Terrain
from missions.frame import LocalFrame
from missions.reassignment import Reassign
from sitl.formation.law import Gains
from sitl.formation.network import Network

Arm = Literal["full", "own_schedule", "plain"]
"""Of a comparison: neighbours' corrections and own schedule, own schedule only, or a plain autopilot."""


@dataclass(frozen=True)
class VehicleConfig:
    """One simulated vehicle.

    Attributes:
        sysid, name: of the vehicle.
        frame: the scenario's local frame.
        home_m: where it stands: (x, y, z), local frame.
        airframe, terrain: what flies, and over what.
        seed: of the gusts, and of what becomes of samples on their way.
        steady_wind_m_s: what blows, (east, north).
        forecast_wind_m_s: what the schedule reckons with, (east, north).
        gusts: intensity, a key of `sitl.aircraft.gusts.INTENSITIES_M_S`.
        gains: of the formation law.
        network: of its swarm.
        arm: how much of the law is on.
        swarm_clock: the schedule is slowed and hurried with the neighbours'.
        real_time: nobody waits for anybody; in lockstep otherwise.
        avoid_m: the safe distance, where vehicles give way to each other; None where they do not.
        reassign: finds who takes whose place when some are lost; None where all keep their own.
    """

    sysid: int
    name: str
    frame: LocalFrame
    home_m: tuple[float, float, float]
    airframe: Airframe
    terrain: Terrain
    seed: int
    steady_wind_m_s: tuple[float, float]
    forecast_wind_m_s: tuple[float, float]
    gusts: str
    gains: Gains
    network: Network
    arm: Arm
    swarm_clock: bool = False
    real_time: bool = False
    avoid_m: float | None = None
    reassign: Reassign | None = None
