"""A run: one folder with a scenario, its plan, its flight and what came of it.

RUN/{scenario.toml, plan.json, endpoints.json, missions/, logs/<sysid>.tlog, truth/<sysid>.f64, metrics.json, figures/}

and terrain.npz, the ground of a scenario with a raster: the file that it names may move.
"""

import contextlib
import itertools
import json
import logging
import shutil
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gcs.export import ExportOptions, export
from gcs.file_lock import lock
from missions.elevation import write_local_raster
from missions.errors import InputError
from missions.scenario import Scenario, parse_scenario
from planner.formation_plan import FormationPlan, load_plan

_log = logging.getLogger(__name__)

RUNS = Path("runs")
"""Where runs go that are given no folder."""


@dataclass(frozen=True)
class RunFolder:
    """The folder of one run."""

    path: Path

    @property
    def scenario(self) -> Path:
        """The scenario's file."""
        return self.path / "scenario.toml"

    @property
    def truth(self) -> Path:
        """Folder of the endpoints' truth."""
        return self.path / "truth"

    @property
    def logs(self) -> Path:
        """Folder of the vehicles' telemetry logs."""
        return self.path / "logs"

    @property
    def figures(self) -> Path:
        """Folder of the pictures."""
        return self.path / "figures"

    @property
    def raster(self) -> Path:
        """The ground, where the scenario has a raster."""
        return self.path / "terrain.npz"

    def discard_if_empty(self) -> None:
        """Remove the folder again when nothing came of it."""
        with contextlib.suppress(OSError):
            self.path.rmdir()

    def write_plan(self, scenario_text: str, scenario: Scenario, plan: FormationPlan) -> None:
        """Keep a scenario and its plan, with each vehicle's mission as files for other stations.

        Raises:
            InputError: the folder cannot be written to.
        """
        try:
            self.scenario.write_text(scenario_text, encoding="utf-8")
            if scenario.raster is not None:
                write_local_raster(scenario.raster, self.raster)
            plan.save(self.path / "plan.json")
            missions = self.path / "missions"
            missions.mkdir(exist_ok=True)
        except OSError as error:
            raise _unwritable(self.path, error) from None
        _log.info("%s: scenario and plan written", self.path)
        for file_format in ("plan", "waypoints"):
            export(scenario, plan, ExportOptions(file_format), missions)

    def read(self) -> tuple[Scenario, FormationPlan]:
        """The scenario and the plan of this run.

        Raises:
            InputError: this is no run, or its files cannot be used.
        """
        file = self.scenario
        try:
            text = file.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
            raise InputError(f"{file}: {reason}; is {self.path} a run? `skein plan` makes one") from None
        _log.info("%s: reading scenario and plan", self.path)
        return parse_scenario(text, str(file), self.path, self.raster.absolute()), load_plan(self.path / "plan.json")

    @contextlib.contextmanager
    def flying(self) -> Iterator[None]:
        """Make room for a flight, and keep others from flying this run until the block ends.

        Raises:
            InputError: it is being flown, or the folder cannot be written to.
        """
        try:
            file = (self.path / ".lock").open("ab")
        except OSError as error:
            raise _unwritable(self.path, error) from None
        with file:
            if not lock(file):
                raise InputError(f"{self.path}: is being flown already; wait for that, or plan another run with --out")
            self.begin_flight()
            yield

    def begin_flight(self) -> None:
        """Make room for a flight; an earlier one of this run is removed.

        Raises:
            InputError: the folder cannot be written to.
        """
        try:
            for folder in (self.truth, self.logs, self.figures):
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
            for name in ("metrics.json", "endpoints.json"):
                (self.path / name).unlink(missing_ok=True)
        except OSError as error:
            raise _unwritable(self.path, error) from None

    def write_json(self, name: str, values: Any) -> None:
        """Write a JSON file of the run. Raises InputError when it cannot be written."""
        text = json.dumps(values, indent=1, allow_nan=False) + "\n"
        file = self.path / name
        try:
            file.write_text(text, encoding="utf-8")
            _log.info("%s written", file)
        except OSError as error:
            file.unlink(missing_ok=True)  # rather none than half of one
            raise _unwritable(file, error) from None


def make_run_folder(out: Path | None, scenario_name: str) -> RunFolder:
    """A new folder for a run.

    Args:
        out: the folder, new or empty; None for one under `RUNS` named after scenario and time.

    Raises:
        InputError: it cannot be made, or holds something.
    """
    if out is None:
        stamp = time.strftime("%Y%m%d-%H%M%S")
        endings = itertools.chain([""], (f"-{i}" for i in itertools.count(2)))
        candidates: Iterable[Path] = (RUNS / f"{scenario_name}-{stamp}{ending}" for ending in endings)
    else:
        candidates = [out]
    for path in candidates:
        try:
            path.mkdir(parents=True, exist_ok=out is not None)
            if any(path.iterdir()):
                raise InputError(f"{path}: is not empty; name a new folder with --out")
            return RunFolder(path)
        except FileExistsError:
            if out is not None:
                raise InputError(f"{path}: is a file; name a folder with --out") from None
        except OSError as error:
            raise _unwritable(path, error) from None
    raise AssertionError("there is always another name")


def _unwritable(path: Path, error: OSError) -> InputError:
    return InputError(f"{path}: {error.strerror}; choose a folder that can be written to with --out")
