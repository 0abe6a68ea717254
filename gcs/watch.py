"""Watching a flight: what each vehicle does, who has arrived, who was lost, and when to stop."""

import asyncio
import math
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.flight_modes import mode_name
from gcs.flight_record import LOST, Event
from gcs.vehicle_link import VehicleLink
from sitl.child import Endpoint

PERIOD_S = 0.1
OVERTIME_S = 120.0
"""A vehicle that has not arrived so long after its plan, in simulated time, is waited for no longer."""
SILENT_S = 10.0
"""A vehicle that has not been heard for so long, in wall time, is named: in lockstep the swarm waits for it."""
STALL_S = 30.0
"""A swarm whose simulated time has stood still for so long, in wall time, is waited for no longer."""


@dataclass
class VehicleStatus:
    """What the station knows of one vehicle in flight.

    Attributes:
        planned_arrival_s: simulated time;
        latest_arrival_s: the same, if the swarm's clock slows down as much as it can.
        items: of its mission.
        time_s: newest simulated time heard of.
        arrived_s: when it was first heard of at the end of its mission, simulated time; NaN before.
        silent: it has been named as not answering.
        lost: why it was lost; None if it was not.
    """

    sysid: int
    name: str
    planned_arrival_s: float
    latest_arrival_s: float
    items: int
    time_s: float = 0.0
    mode: str = ""
    item: int = 0
    airspeed_m_s: float = 0.0
    altitude_m: float = 0.0
    cross_track_m: float = 0.0
    arrived_s: float = math.nan
    silent: bool = False
    lost: str | None = None

    @property
    def arrived(self) -> bool:
        """Whether its mission is complete."""
        return not math.isnan(self.arrived_s)

    def update(self, link: VehicleLink) -> None:
        """Take over the newest telemetry."""
        self.time_s = link.simulated_ms / 1000.0
        if heartbeat := link.latest.get("HEARTBEAT"):
            self.mode = mode_name(heartbeat.custom_mode, link.autopilot)
        if hud := link.latest.get("VFR_HUD"):
            self.airspeed_m_s, self.altitude_m = hud.airspeed, hud.alt
        if navigation := link.latest.get("NAV_CONTROLLER_OUTPUT"):
            self.cross_track_m = navigation.xtrack_error
        if current := link.latest.get("MISSION_CURRENT"):
            self.item = current.seq
            if not self.arrived and current.mission_state == mavlink.MISSION_STATE_COMPLETE:
                self.arrived_s = self.time_s


Announce = Callable[[str], None]
"""Called with each step of a flight, and with what goes wrong in it, for people to read."""
Display = Callable[[list[VehicleStatus]], None]


async def watch_flight(
    statuses: list[VehicleStatus],
    links: Mapping[int, VehicleLink],
    endpoints: Mapping[int, Endpoint],
    display: Display,
    check: Callable[[], None],
    announce: Announce,
    until: asyncio.Event | None = None,
) -> list[Event]:
    """Watch until every vehicle has arrived or was lost, or it is no use to wait longer.

    Args:
        statuses: one a vehicle; kept up to date.
        links, endpoints: of the vehicles, by sysid.
        display: called ten times a second with the statuses.
        check: called as often; raises when it is no use to go on.
        announce: called with who falls silent, and who answers again.
        until: of a flight that somebody steers: it lasts until this is set, whatever the vehicles do.

    Returns:
        What happened, in order.
    """
    events: list[Event] = []
    newest_s, moved_at = -1.0, time.monotonic()
    while True:
        for status in statuses:
            if status.lost is None:
                events.extend(_news(status, links[status.sysid], endpoints[status.sysid], announce))
        display(statuses)
        check()
        if until is not None:
            if until.is_set():
                return events
            await asyncio.sleep(PERIOD_S)
            continue
        left = [status for status in statuses if status.lost is None]
        flying = [status for status in left if not status.arrived]
        # In lockstep vehicles may be some ticks apart: all are to live to see the last one's arrival.
        if not flying and all(status.time_s >= max(one.arrived_s for one in left) for status in left):
            return events
        if (now_s := max((status.time_s for status in left), default=0.0)) > newest_s:
            newest_s, moved_at = now_s, time.monotonic()
        late = [status for status in flying if now_s - status.latest_arrival_s > OVERTIME_S]
        if late:
            events.extend(Event(status.time_s, status.sysid, "did not arrive in time") for status in late)
            return events
        if time.monotonic() - moved_at > STALL_S:
            # In lockstep all wait for the one that stands still. If all answer it is one that is farthest behind.
            behind_s = min(status.time_s for status in left)
            awaited = [status for status in left if status.silent] or [s for s in left if s.time_s == behind_s]
            events.extend(Event(status.time_s, status.sysid, f"stood still for {STALL_S:g} s") for status in awaited)
            return events
        await asyncio.sleep(PERIOD_S)


def _news(status: VehicleStatus, link: VehicleLink, endpoint: Endpoint, announce: Announce) -> Iterator[Event]:
    """Bring one vehicle's status up to date; what has happened to it since."""
    status.update(link)
    status.lost = endpoint.obituary()
    if status.lost is not None:
        yield Event(status.time_s, status.sysid, f"{LOST}{status.lost}")
    elif not status.silent and link.silent_s > SILENT_S:
        status.silent = True
        yield _told(status, f"has not answered for {SILENT_S:g} s", announce)
    elif status.silent and link.silent_s <= SILENT_S:
        status.silent = False
        yield _told(status, "answers again", announce)


def _told(status: VehicleStatus, what: str, announce: Announce) -> Event:
    announce(f"vehicle {status.sysid} {what}")
    return Event(status.time_s, status.sysid, what)
