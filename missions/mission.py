"""A mission as the wire carries it: what one vehicle is told to fly."""

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass, replace

from missions.commands import LOCAL_FRAMES, Frame


def as_float32(value: float) -> float:
    """The nearest float32, as a Python float: what a MAVLink parameter can hold. Overflow gives an infinity."""
    try:
        return float(struct.unpack("<f", struct.pack("<f", value))[0])
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


_FLOAT_NAMES = ("param1", "param2", "param3", "param4", "alt_m")
_FLOATS = struct.Struct("<5f")

_PLAIN_FRAMES = {
    int(Frame.GLOBAL_INT): int(Frame.GLOBAL),
    int(Frame.GLOBAL_RELATIVE_ALT_INT): int(Frame.GLOBAL_RELATIVE_ALT),
    int(Frame.GLOBAL_TERRAIN_ALT_INT): int(Frame.GLOBAL_TERRAIN_ALT),
}


@dataclass(frozen=True)
class MissionItem:
    """One MISSION_ITEM_INT.

    Latitude and longitude are integers of 1e-7 degrees; parameters and altitude are rounded to float32 on
    construction, so that two items are equal exactly when their wire forms are.

    Attributes:
        command: MAV_CMD number.
        frame: MAV_FRAME number; the *_INT frames are stored as their plain forms (5 as 0, 6 as 3, 11 as 10).
        param1, param2, param3, param4: the command's parameters; NaN means "default".
        lat_e7, lon_e7: position in 1e-7 degrees.
        alt_m: altitude in metres, above what `frame` says.
        autocontinue: whether to go on to the next item.
    """

    command: int
    frame: int = Frame.GLOBAL
    param1: float = 0.0
    param2: float = 0.0
    param3: float = 0.0
    param4: float = 0.0
    lat_e7: int = 0
    lon_e7: int = 0
    alt_m: float = 0.0
    autocontinue: bool = True

    def __post_init__(self) -> None:
        exact = (self.param1, self.param2, self.param3, self.param4, self.alt_m)
        try:
            rounded = _FLOATS.unpack(_FLOATS.pack(*exact))  # all at once, since items come by the hundred
        except OverflowError:
            rounded = tuple(map(as_float32, exact))
        if math.isnan(sum(rounded)):
            rounded = tuple(math.nan if math.isnan(value) else value for value in rounded)
        frame = _PLAIN_FRAMES.get(self.frame, int(self.frame))
        self.__dict__.update(zip(_FLOAT_NAMES, rounded, strict=True), command=int(self.command), frame=frame)

    @property
    def params(self) -> tuple[float, float, float, float]:
        """The four parameters, in order."""
        return (self.param1, self.param2, self.param3, self.param4)

    @property
    def lat_deg(self) -> float:
        """Latitude in degrees; in a frame that is not global, param5 as files have it (metres, or a plain number)."""
        return self.lat_e7 / position_scale(self.frame)

    @property
    def lon_deg(self) -> float:
        """Longitude in degrees; in a frame that is not global, param6 as files have it."""
        return self.lon_e7 / position_scale(self.frame)


@dataclass(frozen=True)
class Mission:
    """The items of one vehicle's mission, in order; item 0 is home (ArduPilot's convention)."""

    items: tuple[MissionItem, ...]

    def __len__(self) -> int:
        return len(self.items)

    def __iter__(self) -> Iterator[MissionItem]:
        return iter(self.items)

    def __getitem__(self, seq: int) -> MissionItem:
        return self.items[seq]

    @property
    def home(self) -> MissionItem:
        """Item 0."""
        return self.items[0]

    def with_home(self, home: MissionItem) -> "Mission":
        """The same mission with item 0 replaced, as ArduPlane does on receipt."""
        return replace(self, items=(home, *self.items[1:]))


def position_scale(frame: int) -> float:
    """What param5 and param6 are multiplied by for the x and y of MISSION_ITEM_INT."""
    if frame == Frame.MISSION:
        return 1.0
    return 1e4 if frame in LOCAL_FRAMES else 1e7


def degrees_to_e7(angle_deg: float) -> int:
    """Degrees to the wire's 1e-7 degrees, rounded (truncation is 1 cm off)."""
    return round(angle_deg * 1e7)
