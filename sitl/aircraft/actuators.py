"""Actuators as first-order lags, solved exactly over a tick."""

import math
from typing import NamedTuple

from missions.airframe import Airframe
from sitl.aircraft.point_mass import Controls


class LagGains(NamedTuple):
    """Share of the way from the present value to the command that each actuator goes in one tick."""

    thrust: float
    lift: float
    bank: float


def lag_gains(airframe: Airframe, dt: float) -> LagGains:
    """1 - exp(-dt / lag) of each actuator."""
    return LagGains(
        -math.expm1(-dt / airframe.thrust_lag_s),
        -math.expm1(-dt / airframe.lift_lag_s),
        -math.expm1(-dt / airframe.bank_lag_s),
    )


def lagged(controls: Controls, command: Controls, gains: LagGains) -> Controls:
    """What the actuators deliver one tick later."""
    return Controls(
        controls.thrust + gains.thrust * (command.thrust - controls.thrust),
        controls.lift + gains.lift * (command.lift - controls.lift),
        controls.bank + gains.bank * (command.bank - controls.bank),
    )
