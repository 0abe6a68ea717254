"""What moves: the aircraft with their labels and trails, and the links of the formation."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt
import viser

from gcs.console import glyph
from gcs.console.attitude import quaternions
from gcs.console.link_colour import link_colour
from gcs.console.moment import Moment, ShownLink
from gcs.console.place import Place
from gcs.console.world import rgb

FloatArray = npt.NDArray[np.float64]

LABELS = 30
"""With more vehicles than this only the selected one has a label."""
FAR_BELOW = np.array([0.0, 0.0, -1e3])
"""Where what is not known is put out of sight, in units of the scene."""
LOST = (150, 150, 150)


class SwarmView:
    """The aircraft in a scene; they may become more.

    Args:
        scene: to draw into.
        place: where they fly.
        on_click: called with the sysid of an aircraft that somebody points at.

    Attributes:
        size: of an aircraft, in units of the scene.
        selected: the vehicle that has a label in any case.
        labelled: whether the others may have labels.
    """

    def __init__(self, scene: viser.SceneApi, place: Place, on_click: Callable[[int], None]) -> None:
        self.size = place.aircraft_size
        self.selected: int | None = None
        self.labelled = True
        self._scene = scene
        self._chart = place.chart
        self._colour_of = place.colour_of
        self._limits_s = (place.margin_s, place.stale_s)
        self._on_click = on_click
        self._sysids: tuple[int, ...] = ()
        self._lost: frozenset[int] = frozenset()
        self._places = np.empty((0, 3))
        self._pairs: list[tuple[int, int]] = []
        self._aircraft: viser.BatchedMeshHandle | None = None
        self._labels: dict[int, viser.LabelHandle] = {}
        self._trails: viser.LineSegmentsHandle | None = None
        self._links: viser.LineSegmentsHandle | None = None

    def show(self, moment: Moment, names: Mapping[int, str]) -> None:
        """Draw the aircraft where they are now, as often as they move; the links go with them."""
        self._places = self._chart.units(moment.position_m)
        unknown = np.asarray(np.isnan(self._places).any(axis=1))
        self._places[unknown] = FAR_BELOW
        turned = quaternions(moment.attitude_rad).astype(np.float32)
        if moment.sysids != self._sysids or self._aircraft is None:
            self._lost = moment.lost
            self._begin(moment.sysids, turned)
        else:
            if moment.lost != self._lost:
                self._lost = moment.lost
                self._aircraft.batched_colors = self._colours()
            self._aircraft.batched_positions = self._places.astype(np.float32)
            self._aircraft.batched_wxyzs = turned
        self._label(names, unknown)
        if self._links is not None and self._pairs:
            self._links.points = self._link_points()

    def resize(self, size: float) -> None:
        """Draw the aircraft in another size."""
        self.size = size
        if self._aircraft is not None:
            self._aircraft.batched_scales = np.full(len(self._sysids), size, dtype=np.float32)

    def show_trails(self, trails_m: FloatArray) -> None:
        """Draw where they have been, (n, k, 3), in order of the last moment; some times a second."""
        points = self._chart.units(trails_m)
        n, k, _ = points.shape
        if n != len(self._sysids) or n == 0:
            return
        points[:, -1] = self._places  # up to where they are seen now
        for way in points:  # what is not known yet is no way
            known = np.isfinite(way[:, 0])
            way[~known] = way[np.argmax(known)] if known.any() else FAR_BELOW
        segments = np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 3).astype(np.float32)
        if self._trails is None or self._trails.points.shape != segments.shape:
            each = np.array([rgb(self._colour_of(sysid)) for sysid in self._sysids], dtype=np.uint8)
            colours = np.repeat(each, 2 * (k - 1), axis=0).reshape(-1, 2, 3)
            self._trails = self._scene.add_line_segments(
                "/swarm/trails", segments, colours, thickness=4.0, thickness_units="screen"
            )
        else:
            self._trails.points = segments

    def show_links(self, links: Sequence[ShownLink]) -> None:
        """Draw the formation, coloured by how old the corrections are; some times a second."""
        row = {sysid: i for i, sysid in enumerate(self._sysids)}
        shown = [link for link in links if link.pair[0] in row and link.pair[1] in row]
        pairs = [(row[link.pair[0]], row[link.pair[1]]) for link in shown]
        colours = np.array([[link_colour(link.age_s, *self._limits_s)] * 2 for link in shown], dtype=np.uint8)
        if pairs == self._pairs and self._links is not None:
            self._links.colors = colours
            return
        self._pairs = pairs
        if self._links is not None:
            self._links.remove()
            self._links = None
        if pairs:
            self._links = self._scene.add_line_segments(
                "/swarm/links", self._link_points(), colours, thickness=2.5, thickness_units="screen"
            )

    def place_of(self, sysid: int) -> FloatArray | None:
        """Where an aircraft is drawn, (3,) in units of the scene; None when nobody knows."""
        if sysid not in self._sysids:
            return None
        place = self._places[self._sysids.index(sysid)]
        return None if np.array_equal(place, FAR_BELOW) else place

    def _begin(self, sysids: tuple[int, ...], turned: npt.NDArray[np.float32]) -> None:
        self._sysids = sysids
        if self._aircraft is not None:
            self._aircraft.remove()
            self._aircraft = None
        for label in self._labels.values():
            label.remove()
        self._labels.clear()
        if not sysids:
            return
        aircraft = self._scene.add_batched_meshes_simple(
            "/swarm/aircraft",
            glyph.VERTICES,
            glyph.FACES,
            turned,
            self._places.astype(np.float32),
            batched_scales=np.full(len(sysids), self.size, dtype=np.float32),
            batched_colors=self._colours(),
            flat_shading=True,
            side="double",
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )
        aircraft.on_click(lambda event: self._clicked(event.instance_index))
        self._aircraft = aircraft

    def _colours(self) -> npt.NDArray[np.uint8]:
        """Of the aircraft; those that are lost are grey."""
        colours = [LOST if sysid in self._lost else rgb(self._colour_of(sysid)) for sysid in self._sysids]
        return np.array(colours, dtype=np.uint8)

    def _clicked(self, index: int | None) -> None:
        if index is not None and index < len(self._sysids):
            self._on_click(self._sysids[index])

    def _label(self, names: Mapping[int, str], unknown: npt.NDArray[np.bool_]) -> None:
        """Labels follow their aircraft."""
        all_of_them = self.labelled and len(self._sysids) <= LABELS
        for i, sysid in enumerate(self._sysids):
            wanted = not unknown[i] and (all_of_them or sysid == self.selected)
            label = self._labels.get(sysid)
            if not wanted:
                if label is not None:
                    self._labels.pop(sysid).remove()
                continue
            where = self._places[i] + (0.0, 0.0, 0.6 * self.size)
            # Short, since in close formation they are close, too.
            text = f"{sysid} {names.get(sysid, '')}".strip() if sysid == self.selected else str(sysid)
            if label is None:
                self._labels[sysid] = self._scene.add_label(
                    f"/swarm/label/{sysid}", text, position=tuple(where), anchor="bottom-center", font_screen_scale=0.8
                )
            else:
                label.position = where
                if label.text != text:
                    label.text = text

    def _link_points(self) -> npt.NDArray[np.float32]:
        points: npt.NDArray[np.float32] = self._places[np.array(self._pairs)].astype(np.float32)
        return points
