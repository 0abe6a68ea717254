"""Going about in a recorded flight."""

import viser

from gcs.console.inputs import set_value
from gcs.console.recording import Recording

SPEEDS = {"1x": 1.0, "5x": 5.0, "10x": 10.0, "30x": 30.0, "100x": 100.0}
STEP_S = 0.1


class PlaybackPanel:
    """Buttons, and a slider over the time of the flight.

    Args:
        gui: to add them to.
        recording: that is shown.
    """

    def __init__(self, gui: viser.GuiApi, recording: Recording) -> None:
        self._recording = recording
        self._play = gui.add_button("Play", icon=viser.Icon.PLAYER_PLAY)
        self._play.on_click(lambda _: self._set_playing(True))
        self._pause = gui.add_button("Pause", icon=viser.Icon.PLAYER_PAUSE)
        self._pause.on_click(lambda _: self._set_playing(False))
        longest_s = max(STEP_S, recording.duration_s)
        self._time = gui.add_slider("Time, s", min=0.0, max=longest_s, step=STEP_S, initial_value=0.0)
        self._time.on_update(self._moved)
        speeds = gui.add_button_group("Speed", tuple(SPEEDS))
        speeds.on_click(lambda event: self._set_speed(event.target.value))
        self.show()

    def show(self) -> None:
        """Where it is now."""
        for button, visible in ((self._play, not self._recording.playing), (self._pause, self._recording.playing)):
            if button.visible != visible:
                button.visible = visible
        if abs(self._time.value - self._recording.t_s) > STEP_S:
            set_value(self._time, round(self._recording.t_s, 1))

    def _moved(self, event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
        """Go where somebody has moved the slider, unless it was the recording that did."""
        if event.client is not None:
            self._recording.t_s = min(max(float(event.target.value), 0.0), self._recording.duration_s)

    def _set_playing(self, playing: bool) -> None:
        if playing and self._recording.t_s >= self._recording.duration_s:
            self._recording.t_s = 0.0
        self._recording.playing = playing

    def _set_speed(self, chosen: str) -> None:
        self._recording.speed = SPEEDS[chosen]
