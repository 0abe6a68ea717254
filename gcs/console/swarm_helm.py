"""The clock and the network of a simulated swarm, for the page."""

import asyncio

from gcs.flight import Cockpit
from gcs.flight_record import DISTURBANCE, INTERVENTION, Event
from gcs.swarm_network import SwarmNetwork
from sitl.ticks import TICK_S


class SwarmHelm:
    """Both of them.

    Args:
        cockpit: of the flight.
        speed: that it has begun with; 0 for as fast as it goes.

    Attributes:
        held, speed: as they were set last.
    """

    def __init__(self, cockpit: Cockpit, speed: float) -> None:
        self.held = False
        self.speed = speed
        self._cockpit = cockpit
        self._network = SwarmNetwork(cockpit.session, cockpit.swarm.name)

    async def hold(self) -> None:
        """See `ClockHelm`."""
        await asyncio.to_thread(self._cockpit.clock.hold, self._flying())
        self.held = True

    async def release(self) -> None:
        """See `ClockHelm`."""
        await asyncio.to_thread(self._cockpit.clock.release, self._flying())
        self.held = False

    async def pace(self, speed: float) -> None:
        """See `ClockHelm`."""
        await asyncio.to_thread(self._cockpit.clock.pace, speed, self._flying())
        self.speed = speed

    async def disturb(self, delay_s: float, loss: float) -> str:
        """See `NetworkHelm`."""
        tick = await asyncio.to_thread(self._network.disturb, delay_s, loss, self._flying())
        what = f"{delay_s:g} s later, {100.0 * loss:g} % lost"
        self._cockpit.interventions.append(Event(tick * TICK_S, None, f"{DISTURBANCE}{what}, from tick {tick} on"))
        return f"corrections {what}, from {tick * TICK_S:.2f} s on"

    async def kill(self, sysid: int) -> str:
        """See `NetworkHelm`."""
        self._cockpit.swarm.endpoints[sysid].process.kill()
        self.note(sysid, "killed")
        return f"vehicle {sysid}: killed"

    def note(self, sysid: int, what: str) -> None:
        """Keep in the record of the flight that something was done to a vehicle, now."""
        now_s = max(status.time_s for status in self._cockpit.statuses)
        self._cockpit.interventions.append(Event(now_s, sysid, INTERVENTION + what))

    async def ages_s(self) -> dict[tuple[int, int], float | None]:
        """Of the newest corrections that count, by (sender, receiver)."""
        links = await asyncio.to_thread(self._network.links, self._flying())
        return {(link.sender, link.receiver): link.age_s for link in links if link.used or link.age_s is None}

    def _flying(self) -> list[int]:
        return [status.sysid for status in self._cockpit.statuses if status.lost is None]
