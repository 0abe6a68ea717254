"""What does not move: the ground with its contours, radars, obstacles, planned paths, and a scale."""

import math
from typing import Any

import contourpy
import numpy as np
import numpy.typing as npt
import trimesh
import viser
from matplotlib.colors import LinearSegmentedColormap, to_rgb
from matplotlib.ticker import MaxNLocator
from PIL import Image

from gcs.console.chart import SIDE, Chart
from gcs.console.place import Place
from gcs.figures import style
from gcs.figures.paths import Ground
from gcs.theme import LIGHT
from missions.environment import Environment

FloatArray = npt.NDArray[np.float64]

CONTOURS = 14
"""About so many, from the plain to the peaks."""
CONTOUR_RISE = 0.004
"""Lines lie so far above the ground, units of the scene, lest it hide them."""
TURNS = np.linspace(0.0, 2.0 * np.pi, 49)
PATHS = "/world/path"
"""What is planned, in the tree of the scene."""
PATH_POINTS = 400
GREY = 0.84
"""Between white and black, that planned paths are mixed with: aircraft and trails are to stand out."""
FAINT = (120, 120, 120)


def draw_world(scene: viser.SceneApi, place: Place) -> None:
    """Draw all of it; where the ground is not known, a grid."""
    chart = place.chart
    _light(scene)
    if place.ground is None or place.environment is None:
        scene.add_grid(
            "/world/grid", infinite_grid=True, cell_size=0.2, section_size=1.0, cell_color=(232, 232, 232),
            section_color=(205, 205, 205),
        )  # fmt: skip
    else:
        _ground(scene, chart, place.ground)
        _surroundings(scene, chart, place.environment, float(place.ground.z_m.min()))
    for sysid, points in place.paths.items():
        kept = points[np.unique(np.linspace(0, len(points) - 1, PATH_POINTS).astype(np.int64))]
        faint = 0.4 * np.array(to_rgb(place.colour_of(sysid))) + 0.6 * GREY
        draw_line(scene, f"{PATHS}/{sysid}", chart.units(kept), rgb(faint), 1.5)
    draw_scale(scene, chart)


def _light(scene: viser.SceneApi) -> None:
    """From the north-west, as on maps; viser's own bleaches what lies flat."""
    scene.configure_default_lights(enabled=False)
    scene.configure_environment_map(hdri=None)
    scene.add_light_ambient("/light/ambient", intensity=2.0)
    scene.add_light_directional("/light/sun", intensity=1.5, position=(-SIDE, SIDE, SIDE), cast_shadow=False)


def _surroundings(scene: viser.SceneApi, chart: Chart, environment: Environment, low_m: float) -> None:
    """Radars and obstacles, above the lowest ground."""
    for i, radar in enumerate(environment.radars, start=1):
        centre = np.array([radar.x_m, radar.y_m, radar.z_m])
        vertices, faces = _surface(_dome(centre, radar.radius_m, low_m))
        scene.add_mesh_simple(
            f"/world/radar/{i}", chart.units(vertices), faces, color=rgb(style.RADAR), opacity=0.25, side="double",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip
    for i, obstacle in enumerate(environment.obstacles, start=1):
        vertices, faces = _surface(_cylinder(obstacle.x_m, obstacle.y_m, obstacle.radius_m, low_m, obstacle.top_m))
        scene.add_mesh_simple(
            f"/world/obstacle/{i}", chart.units(vertices), faces, color=rgb(style.OBSTACLE), side="double",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip


def draw_scale(scene: viser.SceneApi, chart: Chart) -> None:
    """A bar along the southern edge, of a round length, and which way is north."""
    (x0, y0, z0), (x1, y1, _) = chart.low_m, chart.high_m
    longer_m = max(x1 - x0, y1 - y0)
    length_m = _round_length_m(longer_m / 5.0)
    south_m = y0 - 0.02 * longer_m
    tick_m = 0.008 * longer_m
    bar = [
        [(x0, south_m, z0), (x0 + length_m, south_m, z0)],
        *([(x, south_m - tick_m, z0), (x, south_m + tick_m, z0)] for x in (x0, x0 + length_m)),
    ]
    scene.add_line_segments(
        "/world/scale", chart.units(bar), FAINT, thickness=2.0, thickness_units="screen"
    )  # fmt: skip
    text = f"{length_m / 1000.0:g} km" if length_m >= 1000.0 else f"{length_m:g} m"
    if chart.heights > 1:
        text += f", heights {chart.heights} x"
    where = chart.units((x0 + 0.5 * length_m, south_m - 2.0 * tick_m, z0))
    scene.add_label("/world/scale/length", text, position=tuple(where), anchor="top-center", font_screen_scale=0.9)
    north = chart.units((0.5 * (x0 + x1), y1 + 0.02 * longer_m, z0))
    scene.add_label("/world/north", "N", position=tuple(north), anchor="bottom-center")


def draw_line(
    scene: viser.SceneApi, name: str, points: FloatArray, colour: tuple[int, int, int], pixels: float
) -> None:
    """A line through points (n, 3), in units of the scene."""
    segments = np.stack([points[:-1], points[1:]], axis=1)
    scene.add_line_segments(name, segments, colour, thickness=pixels, thickness_units="screen")


def rgb(colour: Any) -> tuple[int, int, int]:
    """A colour of matplotlib's, as the scene has it."""
    red, green, blue = (round(255 * share) for share in to_rgb(colour))
    return red, green, blue


def _ground(scene: viser.SceneApi, chart: Chart, ground: Ground) -> None:
    if ground.level:
        x0, x1, y0, y1 = ground.extent_m
        z = float(ground.z_m.min())
        corners = chart.units([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)])
        scene.add_mesh_simple(
            "/world/ground", corners, np.array([[0, 1, 2], [0, 2, 3]]), color=rgb(LIGHT.ground[0]), side="double",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip
        return
    x, y = np.meshgrid(ground.x_m, ground.y_m)
    vertices, faces = _surface(np.stack([x, y, ground.z_m], axis=-1))
    mesh = trimesh.Trimesh(chart.units(vertices), faces, visual=_paint(ground), process=False)
    scene.add_mesh_trimesh("/world/ground", mesh, cast_shadow=False, receive_shadow=False)
    _contours(scene, chart, ground)


def _paint(ground: Ground) -> trimesh.visual.TextureVisuals:
    """From the plain to the peaks, as a picture on the ground: colours of vertices would come out as metal."""
    shares = (ground.z_m - ground.z_m.min()) / np.ptp(ground.z_m)
    colours = LinearSegmentedColormap.from_list("ground", LIGHT.ground)(shares, bytes=True)
    picture = Image.fromarray(colours[::-1, :, :3])  # its first row is the northernmost
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=picture, metallicFactor=0.0, roughnessFactor=1.0)
    m, n = ground.z_m.shape
    u, v = np.meshgrid(np.linspace(0.0, 1.0, n), np.linspace(0.0, 1.0, m))
    return trimesh.visual.TextureVisuals(uv=np.stack([u.ravel(), v.ravel()], axis=1), material=material)


def _contours(scene: viser.SceneApi, chart: Chart, ground: Ground) -> None:
    levels = MaxNLocator(CONTOURS).tick_values(float(ground.z_m.min()), float(ground.z_m.max()))
    generator = contourpy.contour_generator(ground.x_m, ground.y_m, ground.z_m)
    segments: list[FloatArray] = []
    for level in levels:
        for line in map(np.asarray, generator.lines(level)):
            points = chart.units(np.column_stack([line, np.full(len(line), level)]))
            points[:, 2] += CONTOUR_RISE
            segments.append(np.stack([points[:-1], points[1:]], axis=1))
    if segments:
        scene.add_line_segments(
            "/world/ground/contours", np.concatenate(segments), (105, 98, 84), thickness=1.0, thickness_units="screen"
        )


def _dome(centre_m: FloatArray, radius_m: float, low_m: float) -> FloatArray:
    """A sphere as a grid of points; what would lie below the ground is not shown."""
    rise = np.linspace(0.0, np.pi, 33)
    ring = np.stack(
        [
            np.outer(np.sin(rise), np.cos(TURNS)),
            np.outer(np.sin(rise), np.sin(TURNS)),
            np.outer(np.cos(rise), np.ones_like(TURNS)),
        ],
        axis=-1,
    )
    points = centre_m + radius_m * ring
    keep = points[:, 0, 2] >= low_m
    rim = math.sqrt(max(0.0, radius_m**2 - (low_m - centre_m[2]) ** 2))
    if not keep.all():
        foot = centre_m[:2] + rim * np.stack([np.cos(TURNS), np.sin(TURNS)], axis=-1)
        points = np.concatenate([points[keep], [np.column_stack([foot, np.full(len(TURNS), low_m)])]])
    return points


def _cylinder(x_m: float, y_m: float, radius_m: float, low_m: float, top_m: float) -> FloatArray:
    """Wall and roof, as a grid of points."""
    rings = [(radius_m, low_m), (radius_m, top_m), (0.0, top_m)]
    return np.stack(
        [np.column_stack([x_m + r * np.cos(TURNS), y_m + r * np.sin(TURNS), np.full(len(TURNS), z)]) for r, z in rings]
    )


def _surface(grid: FloatArray) -> tuple[FloatArray, npt.NDArray[np.uint32]]:
    """A grid (m, n, 3) as vertices (m n, 3) and triangles."""
    m, n, _ = grid.shape
    a = (np.arange(m - 1)[:, None] * n + np.arange(n - 1)).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + n + 1], axis=1), np.stack([a, a + n + 1, a + n], axis=1)])
    return grid.reshape(-1, 3), faces.astype(np.uint32)


def _round_length_m(length_m: float) -> float:
    """The largest of 1, 2, 5, 10, ... that is no longer."""
    power = 10.0 ** math.floor(math.log10(length_m))
    return max(one * power for one in (1.0, 2.0, 5.0) if one * power <= length_m)
