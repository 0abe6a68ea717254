"""The table of the aircraft type."""

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from missions.airframe import Airframe
from missions.scenario.keys import Fraction, Keys, Number, Positive


class AirframeModel(Keys):
    """The aircraft type. Sources of the shipped values stand in the shipped files."""

    name: str
    mass_kg: Positive
    wing_area_m2: Positive
    drag_coefficient_zero_lift: Positive
    """C_D0."""
    induced_drag_factor: Positive
    """C_D = C_D0 + this times C_L squared."""
    lift_coefficient_max: Positive
    shaft_power_w: Positive
    """Of the engine."""
    propeller_efficiency: Fraction
    static_thrust_n: Positive
    """At most, however slow it flies."""
    airspeed_min_m_s: Positive
    airspeed_max_m_s: Positive
    airspeed_cruise_m_s: Positive
    climb_rate_min_m_s: Annotated[Number, Field(lt=0)]
    """The steepest sink."""
    climb_rate_max_m_s: Positive
    load_factor_max: Annotated[Number, Field(gt=1)]
    """Lift over weight."""
    bank_max_deg: Annotated[Number, Field(gt=0, lt=80)]
    thrust_lag_s: Positive
    """Time constant."""
    bank_lag_s: Positive
    """Time constant."""
    lift_lag_s: Positive
    """Time constant."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if not self.airspeed_min_m_s < self.airspeed_cruise_m_s < self.airspeed_max_m_s:
            raise ValueError("airspeeds must rise from airspeed_min_m_s over airspeed_cruise_m_s to airspeed_max_m_s")
        return self

    def airframe(self) -> Airframe:
        """The values for the compiled core."""
        values = self.model_dump(exclude={"name", "bank_max_deg"})
        return Airframe(bank_max=math.radians(self.bank_max_deg), **values)
