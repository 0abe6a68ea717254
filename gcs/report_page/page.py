"""The page itself: what it says of one run, or of two side by side."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from plotly.offline import get_plotlyjs

from gcs.figures import style
from gcs.flight_record import INTERVENTION
from gcs.metrics import Check
from gcs.report_page.delays import DelayPoint
from gcs.report_page.flown_run import FlownRun
from gcs.report_page.pictures import Picture, pictures, scene_png
from gcs.report_page.scene import scene_html
from gcs.versions import versions
from missions.errors import InputError

NONE = "-"


@dataclass(frozen=True)
class Figure:
    """One key figure."""

    label: str
    value: str
    note: str = ""


@dataclass(frozen=True)
class CheckRow:
    """All vehicles' checks of one kind, by the one with the least room."""

    check: Check
    passed: bool
    count: int


@dataclass(frozen=True)
class View:
    """What the page shows of a run."""

    run: FlownRun
    prefix: str
    figures: list[Figure]
    checks: list[CheckRow]
    pictures: list[Picture]
    scene: str
    scene_png: str
    colours: dict[int, Any]
    commands: list[str]
    steered: bool
    lost: str


def write_page(runs: Sequence[tuple[FlownRun, Sequence[DelayPoint]]], file: Path) -> None:
    """Write one run, or two side by side, as a file that needs nothing else.

    Args:
        runs: each with what rehearsals at other delays came to.
        file: of the page.

    Raises:
        InputError: it cannot be written.
    """
    views = [_view(run, delays, f"r{i}-") for i, (run, delays) in enumerate(runs)]
    page = _template().render(
        views=views,
        title=" and ".join(dict.fromkeys(view.run.scenario.name for view in views)),
        plotly=get_plotlyjs(),
        versions=list(versions().items()),
        dash=NONE,
    )
    unfinished = file.with_name(f".{file.name}.part")
    try:
        unfinished.write_text(page, encoding="utf-8")
        unfinished.replace(file)  # an earlier page is kept until this one is whole
    except OSError as error:
        unfinished.unlink(missing_ok=True)
        raise InputError(f"{file}: {error.strerror}; name another file with --out") from None


def _template() -> Any:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("page.html")


def _view(run: FlownRun, delays: Sequence[DelayPoint], prefix: str) -> View:
    return View(
        run=run,
        prefix=prefix,
        figures=_figures(run),
        checks=rows_of(run.checks),
        pictures=pictures(run, delays, prefix),
        scene=scene_html(run, f"{prefix}scene"),
        scene_png=scene_png(run),
        colours=style.vehicle_colours(run.scenario),
        commands=_commands(run),
        steered=any(event.what.startswith(INTERVENTION) for event in run.metrics.events),
        lost=_lost(run),
    )


def _lost(run: FlownRun) -> str:
    """Who did not arrive although all is well: it was lost when the scenario says so."""
    names = [vehicle.name for vehicle in run.metrics.vehicles if vehicle.lost_s is not None]
    return f"; {', '.join(names)} lost as scheduled, and not expected to arrive" if names else ""


def _figures(run: FlownRun) -> list[Figure]:
    metrics, formation = run.metrics, run.metrics.formation
    arrived = sum(vehicle.completed for vehicle in metrics.vehicles)
    delay = f"{metrics.delay_s:g} s"
    if formation.measured_delay_s is not None:
        delay = f"{formation.measured_delay_s:.2f} s measured"
    limits = run.scenario.limits
    largest, margin = _shown(formation.max_error_m, ".2f", "m"), _shown(formation.delay_margin_s, ".2f", "s")
    return [
        Figure("arrived", f"{arrived} of {len(metrics.vehicles)}"),
        Figure("formation error", _shown(formation.rms_error_m, ".2f", "m"), f"largest {largest}"),
        Figure("arrival spread", _shown(formation.arrival_spread_s, ".2f", "s")),
        Figure("least separation", _shown(formation.min_separation_m, ".0f", "m"), f"safe: {limits.separation_m:g} m"),
        Figure("clearance to spare", _shown(formation.clearance_margin_m, ".0f", "m"), "beyond what is asked for"),
        Figure("radar exposure", f"{formation.radar_exposure_s:.0f} s"),
        Figure("delay", delay, f"margin {margin}"),
        Figure("flight", f"{metrics.timing.flight_sim_s:.0f} s", _pace(run)),
    ]


def _pace(run: FlownRun) -> str:
    timing = run.metrics.timing
    return f"flown in {timing.flight_wall_s:.1f} s, {timing.real_time_factor:.0f} times real time"


def rows_of(checks: Sequence[Check]) -> list[CheckRow]:
    """A row for each kind of check, in the order in which they come first."""
    kinds = list(dict.fromkeys(check.what for check in checks))
    rows = []
    for _, same in groupby(sorted(checks, key=lambda check: kinds.index(check.what)), lambda check: check.what):
        found = sorted(same, key=lambda check: check.room)
        rows.append(CheckRow(found[0], found[0].room >= 0.0, len(found)))
    return rows


def _commands(run: FlownRun) -> list[str]:
    """What makes this flight again, from the scenario below in a file."""
    metrics = run.metrics
    arms = {"plain": " --no-corrections", "own_schedule": " --no-neighbours", "full": ""}
    options = f" --seed {metrics.seed} --delay {metrics.delay_s:g}{arms[metrics.arm]}"
    again = shlex.quote(f"{run.name}-again")
    return [
        f"skein plan {shlex.quote(run.scenario.name + '.toml')} --seed {run.plan.seed} --out {again}",
        f"skein fly {again}{options}{' --real-time' if metrics.real_time else ''}",
        f"skein report {again}",
    ]


def _shown(value: float | None, form: str, unit: str) -> str:
    return NONE if value is None else f"{value:{form}} {unit}"
