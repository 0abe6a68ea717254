"""The pictures of a report: drawings that take the page's colours, dark or light."""

import base64
import re
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from gcs.figures import (
    draw_convergence,
    draw_formation,
    draw_plan_views,
    draw_scene,
    draw_schedule,
)
from gcs.figures.delay_curve import draw_delay_curve
from gcs.figures.projections import draw_projection
from gcs.report_page.delays import DelayPoint
from gcs.report_page.flown_run import FlownRun
from gcs.theme import LIGHT

THEMED = {LIGHT.ink: "currentColor", LIGHT.paper: "var(--paper)", LIGHT.grid: "var(--line)"}


class Picture(NamedTuple):
    """A picture and what it shows."""

    svg: str
    caption: str


def pictures(run: FlownRun, delays: Sequence[DelayPoint], prefix: str) -> list[Picture]:
    """All pictures of a run but the scene.

    Args:
        run: that was flown.
        delays: what rehearsals at other delays came to; may be empty.
        prefix: makes names in the page its own.
    """
    scenario, plan, series = run.scenario, run.plan, run.series
    several = len(plan.uavs) > 1
    drawn: list[tuple[Callable[[Path], None], str]] = []
    if several:
        drawn.append(
            (
                lambda path: draw_formation(scenario, series, path),
                "Formation error, over the edges of the graph, and the least distance of any two vehicles.",
            )
        )
    measured = [(point.delay_s, point.rms_error_m) for point in delays if point.rms_error_m is not None]
    margin_s = run.metrics.formation.delay_margin_s
    if len(measured) > 1 and margin_s is not None:
        rms_m = run.metrics.formation.rms_error_m
        flown = None if rms_m is None else (run.metrics.delay_s, rms_m)
        drawn.append(
            (
                lambda path: draw_delay_curve(scenario.name, measured, flown, margin_s, path),
                "The same flight, rehearsed at other delays. Past the margin corrections do harm.",
            )
        )
    drawn += [
        (
            lambda path: draw_schedule(scenario, series, path),
            "How far each vehicle had come, and how far it was from where its plan wanted it.",
        ),
        (
            lambda path: draw_plan_views(plan, scenario, run.truths, path),
            "From above and from the south: planned and flown.",
        ),
        (
            lambda path: draw_projection(plan, scenario, run.truths, "yz", f"{scenario.name}: planned and flown", path),
            "From the east.",
        ),
    ]
    if any(uav.history for uav in plan.uavs):
        drawn.append(
            (
                lambda path: draw_convergence(plan, scenario, path),
                "How the search for each path converged; 1 is the straight line.",
            )
        )
    return [Picture(_svg(draw, f"{prefix}{i}-"), caption) for i, (draw, caption) in enumerate(drawn)]


def scene_png(run: FlownRun) -> str:
    """The scene as a data: address, for paper and for who runs no scripts."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.png"
        draw_scene(run.plan, run.scenario, run.truths, file)
        return "data:image/png;base64," + base64.b64encode(file.read_bytes()).decode()


def _svg(draw: Callable[[Path], None], prefix: str) -> str:
    """A drawing as SVG for a page: in its colours, its names with a prefix, without a size of its own."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "picture.svg"
        draw(file)
        text = file.read_text(encoding="utf-8")
    text = text[text.index("<svg") :]
    for colour, themed in THEMED.items():
        text = text.replace(colour, themed)
    text = re.sub(r'\bid="', f'id="{prefix}', text)
    text = re.sub(r'(url\(|href=")#', rf"\g<1>#{prefix}", text)
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    return re.sub(r'(<svg[^>]*?) width="[^"]*" height="[^"]*"', r"\1", text, count=1)
