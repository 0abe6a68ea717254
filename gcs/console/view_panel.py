"""How the scene is shown."""

import viser

from gcs.console.camera import OVERVIEW
from gcs.console.place import Place
from gcs.console.swarm_view import SwarmView
from gcs.console.world import PATHS

LEAST_TRAIL_S = 30.0
LONGEST_TRAIL_S = 3600.0


class ViewPanel:
    """Sizes, and what is shown at all.

    Args:
        server: of the page.
        place: that is shown.
        swarm: in it.
    """

    def __init__(self, server: viser.ViserServer, place: Place, swarm: SwarmView) -> None:
        gui = server.gui
        usual_s = max(LEAST_TRAIL_S, round(place.duration_s / 8.0))
        self._trail = gui.add_slider(
            "Trail, s", min=0.0, max=max(place.duration_s, LONGEST_TRAIL_S), step=10.0, initial_value=usual_s
        )
        size = gui.add_slider("Aircraft size", min=0.01, max=0.5, step=0.01, initial_value=round(swarm.size, 2))
        size.on_update(lambda _: swarm.resize(float(size.value)))
        labels = gui.add_checkbox("Labels", initial_value=True)
        labels.on_update(lambda _: setattr(swarm, "labelled", labels.value))
        if place.paths:
            paths = gui.add_checkbox("Planned paths", initial_value=True)
            node = server.scene.add_frame(PATHS, show_axes=False)
            paths.on_update(lambda _: setattr(node, "visible", paths.value))
        dark = gui.add_checkbox("Dark", initial_value=False)
        dark.on_update(lambda _: set_theme(gui, dark=dark.value))
        overview = gui.add_button("Overview", icon=viser.Icon.MAP, hint="Look at everything")

        @overview.on_click
        def _(event: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            if event.client is not None:
                with event.client.atomic():
                    event.client.camera.position = OVERVIEW
                    event.client.camera.look_at = (0.0, 0.0, 0.0)

    @property
    def trail_s(self) -> float:
        """How long a trail is."""
        return float(self._trail.value)


def set_theme(gui: viser.GuiApi, *, dark: bool) -> None:
    """Colours of the panel, and its layout."""
    gui.configure_theme(control_width="large", show_logo=False, show_share_button=False, dark_mode=dark)
