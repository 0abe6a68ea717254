"""The operators' guide is true: its commands run in order, end as it says, and print the lines that it shows.

Of a line that is shown the words must be there, in their order; numbers may be others. What is started in another
terminal runs until the end. Blocks that need aircraft are not run: their options must exist.
"""

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from matplotlib import get_data_path

DOCS = Path(__file__).parents[3] / "docs"
GUIDE = DOCS / "operators.md"
PORT = "14550"
"""In the guide; another one when it is run."""
READY = "The clock is held; Enter releases it."
BLOCK = re.compile(r"(?:<!-- (?P<mark>[^>]+) -->\n)?```(?P<kind>sh|text|toml)\n(?P<text>.*?)```", re.S)
TIMEOUT_S = 200


@dataclass(frozen=True)
class Block:
    """Commands, and the lines that the guide shows of what they print; what the comment before them says."""

    commands: str
    mark: str
    shown: tuple[str, ...]


def blocks() -> list[Block]:
    found: list[Block] = []
    for match in BLOCK.finditer(GUIDE.read_text(encoding="utf-8")):
        if match["kind"] == "sh":
            found.append(Block(match["text"], match["mark"] or "", ()))
        elif match["kind"] == "text":
            found[-1] = Block(found[-1].commands, found[-1].mark, tuple(match["text"].splitlines()))
    return found


def words(text: str) -> str:
    """Without numbers, frames of tables and spaces."""
    return re.sub(r"[\d\s.%│┃─━+-]+", " ", text).strip()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The example's folder, with two tiles of its ground."""
    rasterio = pytest.importorskip("rasterio")
    shutil.copy(DOCS / "gap.toml", tmp_path)
    with np.load(Path(get_data_path()) / "sample_data" / "jacksboro_fault_dem.npz") as sample:
        heights, west, east = sample["elevation"], float(sample["xmin"]), float(sample["xmax"])
        south, north = sorted((float(sample["ymin"]), float(sample["ymax"])))
    rows, columns = heights.shape
    width_deg = (east - west) / columns
    for name, first, last in (("west", 0, columns // 2), ("east", columns // 2, columns)):
        edges = (west + first * width_deg, south, west + last * width_deg, north)
        transform = rasterio.transform.from_bounds(*edges, last - first, rows)
        profile = {"driver": "GTiff", "dtype": "int16", "count": 1, "crs": "EPSG:4326", "transform": transform}
        with rasterio.open(tmp_path / f"{name}.tif", "w", height=rows, width=last - first, **profile) as tile:
            tile.write(heights[:, first:last], 1)
    return tmp_path


@pytest.fixture
def run(folder: Path, free_port: Callable[[], int]) -> Iterator[Callable[[Block], tuple[int, str]]]:
    """Runs a block in the example's folder: exit code of its last command, or of the first that fails, and output."""
    port = str(free_port())
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "COLUMNS": "80", "XDG_STATE_HOME": str(folder / "state")}
    others: list[subprocess.Popen[str]] = []

    def moved(commands: str) -> str:
        """To a port that is free."""
        lines = []
        for line in commands.replace(PORT, port).splitlines():
            station = re.match(r"skein (status|upload|params|mode|rtl|abort|check .*--vehicle)\b", line)
            if line.startswith("skein sim"):
                line += f" --udp 127.0.0.1:{port} --tcp-port 0"
            elif station is not None and "--connect" not in line:
                line += f" --connect udpin://127.0.0.1:{port}"
            lines.append(line)
        return "\n".join(lines)

    def start(block: Block) -> tuple[int, str]:
        command = ["bash", "-e", "-c", moved(block.commands)]
        if block.mark == "another terminal":
            (line,) = moved(block.commands).splitlines()
            pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
            other = subprocess.Popen(shlex.split(line), cwd=folder, env=environment, text=True, **pipes)
            others.append(other)
            assert other.stdout is not None
            printed = ""
            while READY not in printed and (said := other.stdout.readline()):
                printed += said
            return 0 if READY in printed else 1, printed
        if block.mark == "Enter in the other terminal":
            (keyboard,) = (other.stdin for other in others)
            assert keyboard is not None
            keyboard.write("\n")
            keyboard.flush()
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        ended = subprocess.run(command, cwd=folder, env=environment, text=True, timeout=TIMEOUT_S, check=False, **pipes)
        return ended.returncode, ended.stdout

    yield start
    for other in others:
        other.send_signal(signal.SIGINT)
        other.communicate(timeout=20)


@pytest.mark.timeout(600)
def test_the_guide_s_commands_do_what_it_says(run: Callable[[Block], tuple[int, str]], folder: Path) -> None:
    for block in blocks():
        if block.mark.startswith("needs aircraft"):
            continue
        code, output = run(block)
        expected = re.fullmatch(r"exit code (\d+)", block.mark)
        assert code == (int(expected[1]) if expected else 0), f"{block.commands}\n{output}"
        printed = words(output)
        for line in block.shown:
            assert words(line) in printed, f"{block.commands}\nshows {line!r}, but it printed:\n{output}"
    assert {path.name for path in (folder / "runs/gap/figures").iterdir()} == {
        *("scene.png", "plan_views.png", "heights.png")
    }


def test_the_example_plans_on_a_joined_tile_as_on_the_sample(folder: Path) -> None:
    from missions.scenario import load_scenario

    rio = pytest.importorskip("rasterio.merge")
    rio.merge([folder / "west.tif", folder / "east.tif"], dst_path=folder / "ground.tif")
    text = (DOCS / "gap.toml").read_text(encoding="utf-8")
    (folder / "tile.toml").write_text(text.replace("matplotlib:jacksboro_fault_dem.npz", "ground.tif"))
    one, other = (load_scenario(str(path)) for path in (DOCS / "gap.toml", folder / "tile.toml"))
    assert one.raster is not None
    assert other.raster is not None
    # The two differ by how exactly degrees are written: no more than a step between neighbouring posts of a cliff.
    assert np.abs(one.raster.posts - other.raster.posts).max() < 1.0


def test_lines_of_the_example_are_its_own() -> None:
    example = (DOCS / "gap.toml").read_text(encoding="utf-8")
    for match in BLOCK.finditer(GUIDE.read_text(encoding="utf-8")):
        if match["kind"] == "toml":
            for line in match["text"].splitlines():
                assert line in example


@pytest.mark.parametrize("block", [block for block in blocks() if block.mark.startswith("needs aircraft")])
def test_commands_that_need_aircraft_are_at_least_ones_that_there_are(block: Block) -> None:
    for line in block.commands.splitlines():
        program, command, *rest = shlex.split(line)
        assert program == "skein"
        helped = subprocess.run(
            [sys.executable, "-m", "gcs.main", command, "--help"], capture_output=True, text=True, check=True
        )
        for option in rest:
            if option.startswith("--"):
                assert option in helped.stdout
