"""Where a browser looks from: at everything, or along with one aircraft."""

import numpy as np
import numpy.typing as npt
import viser

from gcs.console.chart import SIDE

FloatArray = npt.NDArray[np.float64]

OVERVIEW = np.array([-0.3, -0.75, 0.55]) * SIDE
"""From the south-west, and above."""
NEAR = np.array([-4.0, -7.0, 4.0])
"""From an aircraft that is followed, in lengths of it."""


def look_at_everything(server: viser.ViserServer) -> None:
    """How the page begins."""
    server.initial_camera.position = tuple(OVERVIEW)
    server.initial_camera.look_at = (0.0, 0.0, 0.0)


class Follower:
    """Moves the cameras of all browsers along with an aircraft; they may turn and zoom meanwhile.

    Args:
        server: whose browsers.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._place: FloatArray | None = None
        self._size = 1.0
        self._near: set[int] = set()

    def begin(self, place: FloatArray, size: float) -> None:
        """Go near to an aircraft of this size."""
        self._place, self._size = place.copy(), size
        self._near.clear()
        self.follow(place)

    def follow(self, place: FloatArray) -> None:
        """It is there now. A browser that has come since goes there, too."""
        if self._place is None:
            return
        moved = place - self._place
        self._place = place.copy()
        for number, client in self._server.get_clients().items():
            if number not in self._near:
                self._near.add(number)
                with client.atomic():
                    client.camera.position = place + NEAR * self._size
                    client.camera.look_at = place
            elif moved.any():
                client.camera.position = client.camera.position + moved  # what it looks at moves with it

    def end(self) -> None:
        """Follow no longer, and look at everything again."""
        if self._place is not None:
            for client in self._server.get_clients().values():
                with client.atomic():
                    client.camera.position = OVERVIEW
                    client.camera.look_at = np.zeros(3)
        self._place = None
