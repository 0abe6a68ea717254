"""Holding, releasing and pacing a simulated swarm."""

from collections.abc import Callable, Coroutine
from typing import Any

import viser

from gcs.console.helm import ClockHelm

Do = Callable[[str, Coroutine[Any, Any, Any]], None]
"""Does some work, and tells what came of it."""

SPEEDS = {"1x": 1.0, "2x": 2.0, "5x": 5.0, "10x": 10.0, "20x": 20.0, "fastest": 0.0}


class ClockPanel:
    """Buttons for the clock.

    Args:
        gui: to add them to.
        helm: that moves it.
        do: does what is asked for.
    """

    def __init__(self, gui: viser.GuiApi, helm: ClockHelm, do: Do) -> None:
        self._helm = helm
        self._hold = gui.add_button("Hold", icon=viser.Icon.PLAYER_PAUSE, hint="Let simulated time stand still")
        self._hold.on_click(lambda _: do("hold", helm.hold()))
        self._release = gui.add_button("Release", icon=viser.Icon.PLAYER_PLAY, hint="Let simulated time go on")
        self._release.on_click(lambda _: do("release", helm.release()))
        speeds = gui.add_button_group("Speed", tuple(SPEEDS), hint="Simulated seconds a second")
        speeds.on_click(lambda event: do(f"speed {event.target.value}", helm.pace(SPEEDS[event.target.value])))
        self.show()

    def show(self) -> None:
        """Offer what can be done now."""
        for button, visible in ((self._hold, not self._helm.held), (self._release, self._helm.held)):
            if button.visible != visible:
                button.visible = visible
