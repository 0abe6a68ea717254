"""The parameters of a vehicle, by ArduPlane's names: typed, ranged, and kept over restarts."""

import json
import math
from collections.abc import Iterable
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.airframe import Airframe
from missions.errors import InputError
from missions.mission import as_float32
from missions.reference.reference import fillet_radius_m
from sitl.store import Store

REAL = int(mavlink.MAV_PARAM_TYPE_REAL32)
INT8 = int(mavlink.MAV_PARAM_TYPE_INT8)
INT16 = int(mavlink.MAV_PARAM_TYPE_INT16)
INT32 = int(mavlink.MAV_PARAM_TYPE_INT32)

_PIECE = "parameters.json"


@dataclass(frozen=True)
class Parameter:
    """What one parameter is.

    Attributes:
        name: ArduPlane's.
        kind: MAV_PARAM_TYPE.
        default: its value until it is set.
        low, high: what it may be set to.
        read_only: it tells, and cannot be told.
        choices: the whole numbers that it may be set to; any within the limits when empty.
        same_as: the parameter whose value this is, under the name that older or newer firmware has for it.
    """

    name: str
    kind: int
    default: float
    low: float
    high: float
    read_only: bool = False
    same_as: str = ""
    choices: frozenset[int] = frozenset()

    def allows(self, value: float) -> bool:
        """Whether it may have a value."""
        return self.low <= value <= self.high and (not self.choices or value in self.choices)


class Parameters:
    """The values of one vehicle's parameters.

    Args:
        definitions: what there is.
        store: keeps what was set.

    Attributes:
        names: in the order of their indices, which is the alphabet's.
        damage: what of the kept values could not be used, and why, for the stations; None when all is well.
    """

    def __init__(self, definitions: Iterable[Parameter], store: Store) -> None:
        self._definitions = {one.name: one for one in sorted(definitions, key=lambda one: one.name)}
        self._store = store
        self.names: list[str] = list(self._definitions)
        self._indices = {name: index for index, name in enumerate(self.names)}
        self._values = {name: as_float32(one.default) for name, one in self._definitions.items() if not one.same_as}
        self._set: dict[str, float] = {}
        self.damage = self._recall()

    def __contains__(self, name: str) -> bool:
        return name in self._definitions

    def __getitem__(self, name: str) -> float:
        value = self._values.get(name)  # asked at each tick
        return self._values[self._own_name(name)] if value is None else value

    def kind(self, name: str) -> int:
        """MAV_PARAM_TYPE of a parameter."""
        return self._definitions[name].kind

    def index(self, name: str) -> int:
        """Place of a parameter in `names`."""
        return self._indices[name]

    def names_of(self, name: str) -> list[str]:
        """All names of a parameter's value, its own first."""
        own = self._own_name(name)
        return [own, *(one.name for one in self._definitions.values() if one.same_as == own)]

    def set(self, name: str, value: float) -> None:
        """Set a parameter, and keep it; whole numbers are rounded to.

        Raises:
            InputError: it cannot have that value, or could not be kept; it is as it was.
        """
        one = self._definitions[name]
        if one.read_only:
            raise InputError(f"{name} is read-only")
        if one.kind != REAL and math.isfinite(value):
            value = float(round(value))
        if not one.low <= value <= one.high:
            raise InputError(f"{name} must be {one.low:g} to {one.high:g}, got {value:g}")
        if not one.allows(value):
            raise InputError(f"{name} must be one of {', '.join(map(str, sorted(one.choices)))}, got {value:g}")
        own = self._own_name(name)
        changed = self._set | {own: as_float32(value)}
        self._store.write(_PIECE, json.dumps(changed).encode())
        self._set = changed
        self._values[own] = changed[own]

    def tell(self, name: str, value: float) -> None:
        """The vehicle's own news about a read-only parameter."""
        self._values[name] = as_float32(value)

    def _own_name(self, name: str) -> str:
        return self._definitions[name].same_as or name

    def _recall(self) -> str | None:
        """Take what was kept; returns what was wrong with it."""
        try:
            kept = json.loads(self._store.read(_PIECE) or b"{}")
        except InputError as error:
            return f"Parameters at defaults: {error}"
        except ValueError:
            kept = None
        if not isinstance(kept, dict):
            return "Parameters at defaults: what was kept of them is damaged"
        bad = []
        for name, value in kept.items():
            one = self._definitions.get(name)
            if one is None or one.read_only or one.same_as:
                continue  # of another version: no use, no harm
            if isinstance(value, int | float) and one.allows(value):
                self._values[name] = self._set[name] = as_float32(value)
            else:
                bad.append(name)
        return f"At default, as what was kept is damaged: {', '.join(bad)}" if bad else None


def arduplane_parameters(sysid: int, airframe: Airframe) -> list[Parameter]:
    """What every vehicle has."""
    slow, fast = airframe.airspeed_min_m_s, airframe.airspeed_max_m_s
    loiter_m = float(round(fillet_radius_m(fast)))
    return [
        Parameter("AIRSPEED_CRUISE", REAL, airframe.airspeed_cruise_m_s, slow, fast),
        Parameter("AIRSPEED_MAX", REAL, fast, slow, fast),
        Parameter("AIRSPEED_MIN", REAL, slow, slow, fast),
        Parameter("ARMING_CHECK", INT32, 1, 0, 2**21),
        Parameter("FENCE_ACTION", INT8, 1, 0, 8, choices=frozenset({0, 1, 6, 7, 8})),
        Parameter("FENCE_ALT_MAX", REAL, 100.0, 0.0, 10_000.0),
        Parameter("FENCE_ALT_MIN", REAL, -10.0, -100.0, 10_000.0),
        Parameter("FENCE_ENABLE", INT8, 0, 0, 1),
        Parameter("FENCE_RADIUS", REAL, 300.0, 30.0, 100_000.0),
        Parameter("FENCE_RET_ALT", INT16, 0, 0, 32767),
        Parameter("FENCE_RET_RALLY", INT8, 0, 0, 1),
        Parameter("FENCE_TOTAL", INT8, 0, 0, 255, read_only=True),
        Parameter("FENCE_TYPE", INT8, 4, 0, 15),
        Parameter("FS_GCS_ENABL", INT8, 0, 0, 3),
        Parameter("FS_LONG_ACTN", INT8, 0, 0, 4, choices=frozenset({0, 1, 4})),
        Parameter("FS_LONG_TIMEOUT", REAL, 20.0, 1.0, 300.0),
        Parameter("MAV_GCS_SYSID", INT16, 255, 1, 255),
        Parameter("MAV_SYSID", INT16, sysid, 1, 255),
        Parameter("MIS_RESTART", INT8, 0, 0, 1),
        Parameter("MIS_TOTAL", INT16, 1, 0, 32767, read_only=True),
        Parameter("RALLY_INCL_HOME", INT8, 0, 0, 1),
        Parameter("RALLY_LIMIT_KM", REAL, 5.0, 0.0, 1000.0),
        Parameter("RALLY_TOTAL", INT8, 0, 0, 255, read_only=True),
        Parameter("ROLL_LIMIT_DEG", REAL, round(math.degrees(airframe.bank_max)), 0, 90, read_only=True),
        Parameter("RTL_ALTITUDE", REAL, 100.0, -1.0, 10_000.0),
        Parameter("RTL_AUTOLAND", INT8, 0, 0, 2),
        Parameter("RTL_RADIUS", INT16, 0, -32767, 32767),
        Parameter("SYSID_MYGCS", INT16, 255, 1, 255, same_as="MAV_GCS_SYSID"),
        Parameter("SYSID_THISMAV", INT16, sysid, 1, 255, same_as="MAV_SYSID"),
        Parameter("TECS_CLMB_MAX", REAL, airframe.climb_rate_max_m_s, 0.0, 100.0, read_only=True),
        Parameter("TECS_SINK_MAX", REAL, -airframe.climb_rate_min_m_s, 0.0, 100.0, read_only=True),
        Parameter("TKOFF_ALT", REAL, 50.0, 0.0, 200.0),
        Parameter("WP_LOITER_RAD", INT16, loiter_m, -32767, 32767),
        Parameter("WP_RADIUS", INT16, 90, 1, 32767),
    ]
