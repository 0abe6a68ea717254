"""Choosing a vehicle, following it, and giving orders: to it, or to all."""

from collections.abc import Callable, Mapping, Sequence

import viser

from gcs.console.clock_panel import Do
from gcs.console.confirm import ask
from gcs.console.helm import Order, Pilots
from gcs.console.inputs import set_value

ALL = "all vehicles"
HINTS = {
    Order.AUTO: "AUTO: fly the mission",
    Order.LOITER: "LOITER: circle here",
    Order.RTL: "RTL: fly home",
}


class OrderPanel:
    """What can be done with a vehicle.

    Args:
        gui: to add it to.
        pilots: who obey; None where nobody does.
        do: does what is asked for.
        on_choice: called with the vehicle that is chosen; None for all.
        on_follow: called with the vehicle to follow; None for none.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        pilots: Pilots | None,
        do: Do,
        on_choice: Callable[[int | None], None],
        on_follow: Callable[[int | None], None],
    ) -> None:
        self.selected: int | None = None
        self.following: int | None = None
        self._gui = gui
        self._pilots = pilots
        self._do = do
        self._on_choice = on_choice
        self._on_follow = on_follow
        self._sysids: dict[str, int] = {}
        self._choice = gui.add_dropdown("Vehicle", (ALL,))
        self._choice.on_update(lambda _: self._chosen())
        self._follow = gui.add_checkbox("Follow", initial_value=False)
        self._follow.on_update(lambda _: self._chosen())
        if pilots is not None:
            orders = gui.add_button_group(
                "Order", tuple(order.value for order in HINTS), hint="; ".join(HINTS.values())
            )
            orders.on_click(lambda event: self._give(Order(event.target.value)))
            abort = gui.add_button("Abort", color="red", hint="Bring everyone home, after a question")
            abort.on_click(lambda _: self._ask_to_abort())

    def offer(self, sysids: Sequence[int], names: Mapping[int, str]) -> None:
        """These may be chosen."""
        self._sysids = {f"{sysid} {names.get(sysid, '')}".strip(): sysid for sysid in sysids}
        self._choice.options = (ALL, *self._sysids)

    def select(self, sysid: int) -> None:
        """Choose a vehicle."""
        set_value(self._choice, next((text for text, one in self._sysids.items() if one == sysid), ALL))

    def _chosen(self) -> None:
        self.selected = self._sysids.get(self._choice.value)
        self._on_choice(self.selected)
        following = self.selected if self._follow.value else None
        if following != self.following:
            self.following = following
            self._on_follow(following)

    def _give(self, order: Order) -> None:
        assert self._pilots is not None
        sysids = list(self._sysids.values()) if self.selected is None else [self.selected]
        self._do(order.value, self._pilots.order(order, sysids))

    def _ask_to_abort(self) -> None:
        pilots = self._pilots
        assert pilots is not None
        ask(
            self._gui,
            "Abort the flight of all vehicles?",
            "Who flies goes home (RTL); who stands on the ground is disarmed.",
            yes="Abort, bring all home",
            no="Fly on",
            act=lambda: self._do("abort", pilots.order(Order.ABORT, list(self._sysids.values()))),
        )
