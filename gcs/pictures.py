"""Renews the pictures of README and docs: `make pictures` flies the shipped scenarios, the V in all three arms, and
rehearses the example of docs/operators.md."""

import asyncio
import shutil
import sys
import tempfile
from pathlib import Path
from typing import get_args

from PIL import Image

from gcs.console_picture import find_browser, take_picture
from gcs.export import ExportOptions, export
from gcs.figures import draw_arms, draw_formation, draw_mission_files, draw_plan
from gcs.flight import FlightOptions, fly
from gcs.metrics import Series
from gcs.rehearsal import RehearsalOptions, compile_rehearsal, rehearse_plan
from gcs.report import report_on, write_report
from gcs.report_page import read_flown_run
from gcs.run_folder import RunFolder, make_run_folder
from gcs.watch import VehicleStatus
from missions.altitude_frame import AltitudeFrame
from missions.formats.mission_file import read_mission_file
from missions.scenario import load_scenario, read_scenario_text
from planner.plan import plan
from sitl.config import Arm

SCENES = ("radars", "mountains")
FORMATION = "vee"
GUIDE = "gap.toml"
"""Beside the folder of pictures."""
WIDTH_PX = 1200
"""Of a guide's picture: a page of several must load over a field's network."""


def main(folder: Path) -> None:
    """Fly, and draw into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as runs:
        for name in SCENES:
            run, _ = _flown(name, "full", Path(runs) / name)
            shutil.copy(run.figures / "scene.png", folder / f"{name}.png")
        _console(Path(runs) / SCENES[-1], folder / "console.png")
        errors = {arm: _flown(FORMATION, arm, Path(runs) / arm)[1].error for arm in get_args(Arm)}
        draw_arms(load_scenario(FORMATION), errors, folder / "arms.png")
        for picture in _guide(folder.parent / GUIDE, Path(runs)):
            _shrink(picture, folder / f"guide-{picture.name}")


def _console(run: Path, picture: Path) -> None:
    """A console that shows a run half-way."""
    browser = find_browser()
    if browser is None:
        print(f"{picture}: not renewed, since there is no Chromium here", file=sys.stderr)
        return
    flown = read_flown_run(run)
    asyncio.run(take_picture(flown, run / "logs", 0.4 * flown.series.tracks.t_s[-1], browser, picture))
    _shrink(picture, picture)


def _guide(file: Path, folder: Path) -> list[Path]:
    """What the operators' guide shows: the plan, its mission files, its rehearsal."""
    scenario = load_scenario(str(file))
    planned = plan(scenario)
    draw_plan(scenario, planned, folder)
    exported = export(scenario, planned, ExportOptions("plan", altitude=AltitudeFrame.relative), folder)
    missions, formation = folder / "missions.png", folder / "formation.png"
    draw_mission_files({one.stem: read_mission_file(one).plan for one in exported.files}, scenario, missions)
    options = RehearsalOptions(seed=scenario.seed, delay_s=scenario.formation.delay_s, arm="full")
    truths, record = rehearse_plan(scenario, planned, options, compile_rehearsal(scenario, planned))
    draw_formation(scenario, report_on(scenario, planned, truths, record).series, formation)
    return [folder / "scene.png", folder / "heights.png", missions, formation]


def _shrink(source: Path, target: Path) -> None:
    with Image.open(source) as image:
        height_px = round(image.height * WIDTH_PX / image.width)
        smaller = image.convert("RGB").resize((WIDTH_PX, height_px), Image.Resampling.LANCZOS)
        few = smaller.quantize(
            256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE
        )  # thin lines keep theirs
        few.save(target, optimize=True)


def _flown(name: str, arm: Arm, out: Path) -> tuple[RunFolder, Series]:
    """Plan and fly a shipped scenario."""
    (text, _), scenario = read_scenario_text(name), load_scenario(name)
    run, planned = make_run_folder(out, name), plan(scenario)
    run.write_plan(text, scenario, planned)
    options = FlightOptions(delay_s=scenario.formation.delay_s, arm=arm)

    def show_nothing(statuses: list[VehicleStatus]) -> None:
        pass

    record = asyncio.run(fly(scenario, planned, run, options, print, show_nothing))
    return run, write_report(run, scenario, planned, record).series


if __name__ == "__main__":
    main(Path(sys.argv[1]))
