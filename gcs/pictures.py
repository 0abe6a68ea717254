"""Renews the README's pictures: `make pictures` flies the shipped scenarios, and the V in all three arms."""

import asyncio
import shutil
import sys
import tempfile
from pathlib import Path
from typing import get_args

from gcs.figures import draw_arms
from gcs.flight import FlightOptions, fly
from gcs.metrics import Series
from gcs.report import write_report
from gcs.run_folder import RunFolder, make_run_folder
from gcs.watch import VehicleStatus
from missions.scenario import load_scenario
from planner.plan import plan
from sitl.config import Arm

SCENES = ("radars", "mountains")
FORMATION = "vee"


def main(folder: Path) -> None:
    """Fly, and draw into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as runs:
        for name in SCENES:
            run, _ = _flown(name, "full", Path(runs) / name)
            shutil.copy(run.figures / "scene.png", folder / f"{name}.png")
        errors = {arm: _flown(FORMATION, arm, Path(runs) / arm)[1].error for arm in get_args(Arm)}
        draw_arms(load_scenario(FORMATION), errors, folder / "arms.png")


def _flown(name: str, arm: Arm, out: Path) -> tuple[RunFolder, Series]:
    """Plan and fly a shipped scenario."""
    scenario = load_scenario(name)
    run, planned = make_run_folder(out, name), plan(scenario)
    options = FlightOptions(delay_s=scenario.formation.delay_s, arm=arm)

    def show_nothing(statuses: list[VehicleStatus]) -> None:
        pass

    record = asyncio.run(fly(scenario, planned, run, options, print, show_nothing))
    return run, write_report(run, scenario, planned, record).series


if __name__ == "__main__":
    main(Path(sys.argv[1]))
