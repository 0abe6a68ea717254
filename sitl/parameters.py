"""The parameters that an endpoint shows, by ArduPlane's names."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.airframe import Airframe
from missions.reference.reference import fillet_radius_m

_REAL = mavlink.MAV_PARAM_TYPE_REAL32
_INTEGER = mavlink.MAV_PARAM_TYPE_INT16


def arduplane_parameters(sysid: int, airframe: Airframe) -> dict[str, tuple[float, int]]:
    """Name to (value, MAV_PARAM_TYPE)."""
    return {
        "AIRSPEED_CRUISE": (airframe.airspeed_cruise_m_s, _REAL),
        "AIRSPEED_MAX": (airframe.airspeed_max_m_s, _REAL),
        "AIRSPEED_MIN": (airframe.airspeed_min_m_s, _REAL),
        "MAV_SYSID": (sysid, _INTEGER),
        "SYSID_THISMAV": (sysid, _INTEGER),
        "TECS_CLMB_MAX": (airframe.climb_rate_max_m_s, _REAL),
        "TECS_SINK_MAX": (-airframe.climb_rate_min_m_s, _REAL),
        "WP_LOITER_RAD": (round(fillet_radius_m(airframe.airspeed_max_m_s)), _INTEGER),
        "WP_RADIUS": (90, _INTEGER),
    }
