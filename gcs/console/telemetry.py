"""Where vehicles are, by what they tell the station."""

import math
from collections.abc import Callable, Mapping

from gcs.console.track import Sample, Track
from gcs.vehicle_link import VehicleLink
from missions.frame import LocalFrame
from sitl.services.peer import Message

TOGETHER_S = 2.0
"""Vehicles whose clocks differ by less go by one clock."""
BACK_S = 1.0
"""A clock that goes back by so much has begun anew."""


class Telemetry:
    """Follows vehicles as they are heard; what they say is put into one time, and one frame.

    Args:
        frame: of the positions.
        simulated: they all go by one clock, which began at 0.

    Attributes:
        tracks: by sysid.
    """

    def __init__(self, frame: LocalFrame, *, simulated: bool) -> None:
        self.tracks: dict[int, Track] = {}
        self._frame = frame
        self._simulated = simulated
        self._offsets: dict[int, float] = {}

    def follow(self, vehicles: Mapping[int, VehicleLink], listen: Callable[[VehicleLink], None]) -> None:
        """Begin with those that are new; `listen` is called with each of them."""
        for sysid, vehicle in vehicles.items():
            if sysid not in self.tracks:
                self.tracks[sysid] = Track()
                listen(vehicle)

    def on_message(self, sysid: int, vehicle: VehicleLink, message: Message) -> None:
        """A message has come from a vehicle: of its position is made a sample."""
        if message.get_type() != "GLOBAL_POSITION_INT" or not (message.lat or message.lon):
            return  # without a fix both are 0
        attitude = vehicle.latest.get("ATTITUDE")
        x, y = self._frame.from_e7(message.lat, message.lon)
        angles = (0.0, 0.0, 0.5 * math.pi - math.radians(message.hdg / 100.0 if message.hdg != 65535 else 0.0))
        if attitude is not None:
            angles = (attitude.roll, attitude.pitch, 0.5 * math.pi - attitude.yaw)
        track = self.tracks[sysid]
        t_s = message.time_boot_ms / 1000.0 + self._offset_s(sysid, message.time_boot_ms / 1000.0)
        if t_s < track.newest_s - BACK_S:
            track.clear()
        track.add(
            Sample(
                t_s,
                (x, y, message.alt / 1000.0 - self._frame.alt_m),
                (message.vy / 100.0, message.vx / 100.0, -message.vz / 100.0),
                angles,
            )
        )

    def _offset_s(self, sysid: int, boot_s: float) -> float:
        """What is added to a vehicle's clock: nothing in a simulation; else what brings it to that of the first."""
        if self._simulated:
            return 0.0
        offset = self._offsets.get(sysid)
        track = self.tracks[sysid]
        if offset is None or boot_s + offset < track.newest_s - BACK_S:
            newest_s = max((one.newest_s for one in self.tracks.values()), default=-math.inf)
            reference = next(iter(self._offsets.values()), -boot_s)
            close = math.isinf(newest_s) or abs(boot_s + reference - newest_s) < TOGETHER_S
            offset = self._offsets[sysid] = reference if close else newest_s - boot_s
        return offset
