"""The page: the scene, and the panel beside it."""

import asyncio
import concurrent.futures
import html
import time
import traceback
from collections import deque
from collections.abc import Callable, Coroutine
from typing import Any

import viser

from gcs.console.camera import Follower, look_at_everything
from gcs.console.clock_panel import ClockPanel
from gcs.console.confirm import ask
from gcs.console.helm import Helm
from gcs.console.link_colour import FRESH, LATE, STALE
from gcs.console.network_panel import NetworkPanel
from gcs.console.order_panel import OrderPanel
from gcs.console.place import Place
from gcs.console.playback_panel import PlaybackPanel
from gcs.console.plots import Plots
from gcs.console.recording import Recording
from gcs.console.source import Source
from gcs.console.swarm_view import SwarmView
from gcs.console.vehicle_table import table_html
from gcs.console.view_panel import ViewPanel, set_theme
from gcs.console.world import draw_world
from gcs.transfers.errors import TransferError
from missions.errors import InputError

TOLD = 6
"""Lines of what happened that are shown."""
TRAIL_POINTS = 120
FEW_TRAIL_POINTS = 40
"""For more than `FEW` vehicles."""
FEW = 30


class Page:
    """One page, for any number of browsers.

    Args:
        server: that serves it.
        place: what is around the vehicles.
        source: where they are.
        helm: what may be done to them.
        end: called when somebody ends the flight; None where nobody can.

    Made in the event loop that the helm's work is then done in.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        place: Place,
        source: Source,
        helm: Helm,
        end: Callable[[], None] | None = None,
    ) -> None:
        self._server = server
        self._place = place
        self._source = source
        self._loop = asyncio.get_running_loop()
        self._told: deque[str] = deque(maxlen=TOLD)
        self._sysids: tuple[int, ...] = ()
        self._t_s = 0.0
        self._follower = Follower(server)

        server.scene.set_up_direction("+z")
        look_at_everything(server)
        server.gui.set_panel_label(f"Skein: {place.name}")
        server.gui.main_panel.dock_right()
        set_theme(server.gui, dark=False)
        draw_world(server.scene, place)
        self._swarm = SwarmView(server.scene, place, self._select)
        self._add_panel(helm, end)

    def _add_panel(self, helm: Helm, end: Callable[[], None] | None) -> None:
        gui = self._server.gui
        self._status = gui.add_html("")
        self._playback = PlaybackPanel(gui, self._source) if isinstance(self._source, Recording) else None
        self._clock = ClockPanel(gui, helm.clock, self.do) if helm.clock is not None else None
        tabs = gui.add_tab_group()
        with tabs.add_tab("Vehicles", viser.Icon.PLANE):
            self._table = gui.add_html("")
            if self._place.ground is not None:  # else nobody knows of a formation
                gui.add_html(_legend(self._place, told=helm.pilots is None or helm.network is not None))
            self._orders = OrderPanel(gui, helm.pilots, self.do, self._choose, self._set_follow)
        plots = tabs.add_tab("Plots", viser.Icon.CHART_LINE)
        self._plots = Plots(gui, plots, self._source.duration_s if isinstance(self._source, Recording) else None)
        self._network = None
        if helm.network is not None:
            with tabs.add_tab("Network", viser.Icon.ACCESS_POINT):
                self._network = NetworkPanel(gui, helm.network, self.do)
        with tabs.add_tab("View", viser.Icon.EYE):
            self._view = ViewPanel(self._server, self._place, self._swarm)
        if end is not None:
            self._add_end(end)
        self._events = gui.add_html("")

    def _add_end(self, end: Callable[[], None]) -> None:
        button = self._server.gui.add_button(
            "End the flight", color="gray", icon=viser.Icon.FLAG, hint="After a question"
        )
        button.on_click(
            lambda _: ask(
                self._server.gui,
                "End the flight?",
                "The simulation ends where it is; its figures of merit are computed.",
                yes="End it",
                no="Fly on",
                act=lambda: self._loop.call_soon_threadsafe(end),  # type: ignore[arg-type]
            )
        )

    @property
    def watched(self) -> bool:
        """Whether there is a browser."""
        return bool(self._server.get_clients())

    def show(self, passed_s: float) -> None:
        """Draw the next moment."""
        moment = self._source.advance(passed_s)
        self._t_s = moment.t_s
        if not self.watched:
            return
        with self._server.atomic():
            self._swarm.show(moment, self._source.names)
            if moment.sysids != self._sysids:
                self._sysids = moment.sysids
                self._orders.offer(moment.sysids, self._source.names)
                if self._network is not None:
                    self._network.offer(moment.sysids, self._source.names)
        if self._orders.following is not None:
            place = self._swarm.place_of(self._orders.following)
            if place is not None:
                self._follower.follow(place)

    def show_figures(self) -> None:
        """Renew what need not move: table, trails, links, plots; some times a second."""
        course = self._source.course()
        if not self.watched:
            return
        points = TRAIL_POINTS if len(self._sysids) <= FEW else FEW_TRAIL_POINTS
        with self._server.atomic():
            self._swarm.show_trails(self._source.trails(self._view.trail_s, points))
            self._swarm.show_links(self._source.links())
        _set(self._table, table_html(self._source.rows(), self._place.colour_of, self._orders.selected))
        _set(self._status, _status(self._t_s, self._source.state()))
        self._plots.show(course)
        if self._playback is not None:
            self._playback.show()
        if self._clock is not None:
            self._clock.show()

    def bid_farewell(self, line: str) -> None:
        """Say last what has become of it: browsers keep it when there is no server any more."""
        self.tell(line)
        self._status.content = _status(self._t_s, "ended")
        self._server.flush()

    def tell(self, line: str) -> None:
        """Say what has happened."""
        stamp = time.strftime("%H:%M:%S")
        self._told.append(f"{stamp} {line}")
        lines = "".join(f"<div>{html.escape(one)}</div>" for one in self._told)
        self._events.content = f'<div style="font-size:11px;padding:4px 8px;opacity:.85">{lines}</div>'

    def do(self, what: str, work: Coroutine[Any, Any, Any]) -> None:
        """Do what a user asked for, and tell what came of it. Called from the server's threads."""
        asyncio.run_coroutine_threadsafe(self._done(what, work), self._loop)

    async def _done(self, what: str, work: Coroutine[Any, Any, Any]) -> None:
        try:
            result = await work
        except (InputError, TransferError, concurrent.futures.CancelledError) as error:
            self.tell(f"{what}: {error}")
            return
        except Exception as error:  # nobody else would see it
            self.tell(f"{what}: {type(error).__name__}: {error}")
            traceback.print_exc()
            return
        for line in [result] if isinstance(result, str) else result or [what]:
            self.tell(line)

    def _select(self, sysid: int) -> None:
        self._orders.select(sysid)

    def _choose(self, sysid: int | None) -> None:
        self._swarm.selected = sysid

    def _set_follow(self, sysid: int | None) -> None:
        place = None if sysid is None else self._swarm.place_of(sysid)
        if place is None:
            self._follower.end()
        else:
            self._follower.begin(place, self._swarm.size)


def _status(t_s: float, state: str) -> str:
    minutes, seconds = divmod(max(t_s, 0.0), 60.0)
    return (
        '<div style="display:flex;justify-content:space-between;padding:6px 8px;font-size:14px">'
        f'<b style="font-variant-numeric:tabular-nums">{int(minutes)}:{seconds:04.1f}</b>'
        f"<span>{html.escape(state)}</span></div>"
    )


def _legend(place: Place, *, told: bool) -> str:
    """What the colours of the links mean: ages of corrections, where the swarm tells them."""
    what = "age of the newest correction" if told else "silence of the vehicle last heard longest ago"
    colours = ",".join(f"rgb{colour}" for colour in (FRESH, LATE, STALE))
    return (
        f'<div style="font-size:11px;padding:4px 8px"><div>link: {what}</div>'
        f'<div style="height:6px;border-radius:3px;background:linear-gradient(90deg,{colours})"></div>'
        '<div style="display:flex;justify-content:space-between"><span>0 s</span>'
        f"<span>{place.margin_s:.2f} s, margin</span><span>{place.stale_s:.2f} s, stale</span></div></div>"
    )


def _set(handle: viser.GuiHtmlHandle, content: str) -> None:
    """Change what a browser shows, if it is a change."""
    if handle.content != content:
        handle.content = content
