"""What a user does to the network of a simulated swarm, and to its vehicles."""

from collections.abc import Mapping, Sequence

import viser

from gcs.console.clock_panel import Do
from gcs.console.confirm import ask
from gcs.console.helm import NetworkHelm
from gcs.console.inputs import set_value

MOST_DELAY_S = 5.0


class NetworkPanel:
    """Delay, loss, and a vehicle's end.

    Args:
        gui: to add it to.
        helm: that does it.
        do: does what is asked for.
    """

    def __init__(self, gui: viser.GuiApi, helm: NetworkHelm, do: Do) -> None:
        self._gui = gui
        self._helm = helm
        self._do = do
        self._sysids: dict[str, int] = {}
        delay = gui.add_slider(
            "Added delay, s", min=0.0, max=MOST_DELAY_S, step=0.04, initial_value=0.0, hint="Of all corrections"
        )
        loss = gui.add_slider("Added loss, %", min=0, max=100, step=1, initial_value=0, hint="Of all corrections")
        inject = gui.add_button("Inject", hint="Delay and lose from now on")
        inject.on_click(lambda _: do("inject", helm.disturb(float(delay.value), loss.value / 100.0)))
        clear = gui.add_button("Clear", hint="As the scenario has it")

        def cleared() -> None:
            set_value(delay, 0.0)
            set_value(loss, 0)
            do("clear", helm.disturb(0.0, 0.0))

        clear.on_click(lambda _: cleared())
        gui.add_divider()
        self._choice = gui.add_dropdown("Vehicle", ("none",))
        kill = gui.add_button("Kill", color="red", hint="End its process, after a question")
        kill.on_click(lambda _: self._ask_to_kill())

    def offer(self, sysids: Sequence[int], names: Mapping[int, str]) -> None:
        """These may be chosen."""
        self._sysids = {f"{sysid} {names.get(sysid, '')}".strip(): sysid for sysid in sysids}
        self._choice.options = ("none", *self._sysids)

    def _ask_to_kill(self) -> None:
        sysid = self._sysids.get(self._choice.value)
        if sysid is None:
            return
        ask(
            self._gui,
            f"Kill vehicle {sysid}?",
            "Its process ends at once, as if its computer had failed. It does not come back.",
            yes=f"Kill vehicle {sysid}",
            no="Leave it",
            act=lambda: self._do(f"kill vehicle {sysid}", self._helm.kill(sysid)),
        )
