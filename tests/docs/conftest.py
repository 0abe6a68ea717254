"""Guides are true: their commands run in order, end as the page says, and print the lines that it shows.

A fenced block of a page is

- `sh`: commands, run by bash in one folder for the whole page;
- `text`: lines that the commands before it print. Of each the words must be there in their order, numbers may differ;
- `python` or `toml` with a file's name in the comment before it: that file.

The comment before a block says what a reader of the page can see, too: `file: NAME`, `exit code 1`, `another terminal`
(what is started there runs until the page ends, or until `another terminal, after Ctrl-C there`), `Enter in the other
terminal`, or `not run:` and why.
"""

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PORT = "14550"
"""In the pages; another one when they are run."""
READY = ("The clock is held; Enter releases it.", "Ctrl-C ends the simulation.")
BLOCK = re.compile(r"(?:<!-- (?P<mark>[^>]+) -->\n)?^```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.M | re.S)
STATION = re.compile(
    r"skein (status|upload|download|clear|arm|disarm|mode|rtl|abort|params|signing (set|off)|check .*--vehicle)\b"
)
"""Commands that listen on `PORT` unless told otherwise."""
ANOTHER = "another terminal"
TIMEOUT_S = 200


@dataclass(frozen=True)
class Block:
    """What a page has its reader do.

    Attributes:
        kind: sh, python or toml.
        text: commands, or what is in a file.
        mark: of the comment before it.
        shown: lines that the page shows of what the commands print.
    """

    kind: str
    text: str
    mark: str
    shown: tuple[str, ...] = ()


def blocks_of(page: Path) -> list[Block]:
    """The blocks of a page in their order."""
    found: list[Block] = []
    for match in BLOCK.finditer(page.read_text(encoding="utf-8")):
        if match["kind"] == "text":
            found[-1] = Block(found[-1].kind, found[-1].text, found[-1].mark, tuple(match["text"].splitlines()))
        elif match["kind"] in ("sh", "python", "toml"):
            found.append(Block(match["kind"], match["text"], match["mark"] or ""))
    return found


def words(text: str) -> str:
    """Without numbers, frames of tables and spaces."""
    return re.sub(r"[\d\s.%│┃─━+-]+", " ", text).strip()


class Reader:
    """Does what a page says, in a folder, on ports that are free."""

    def __init__(self, folder: Path, port: int) -> None:
        self._folder, self._port = folder, str(port)
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        self._environment = os.environ | {"PATH": path, "COLUMNS": "80", "XDG_STATE_HOME": str(folder / "state")}
        self._others: list[subprocess.Popen[str]] = []

    def follow(self, page: Path) -> None:
        """Do all that is not marked as not to be done. Raises AssertionError where the page is wrong."""
        for block in blocks_of(page):
            if block.mark.startswith("not run:"):
                continue
            if block.kind == "sh":
                self._check(block)
            elif block.mark.startswith("file: "):
                (self._folder / block.mark.removeprefix("file: ")).write_text(self._moved(block.text), encoding="utf-8")

    def end(self) -> None:
        """End what runs in the other terminals; a Ctrl-C would not reach it where these tests run in the background."""
        while self._others:
            other = self._others.pop()
            other.terminate()
            other.communicate(timeout=20)

    def _check(self, block: Block) -> None:
        code, output = self._run(block)
        expected = re.fullmatch(r"exit code (\d+)", block.mark)
        assert code == (int(expected[1]) if expected else 0), f"{block.text}\n{output}"
        printed = words(output)
        for line in block.shown:
            assert words(line) in printed, f"{block.text}\nshows {line!r}, but it printed:\n{output}"

    def _run(self, block: Block) -> tuple[int, str]:
        """Exit code of the last command, or of the first that fails, and what they print."""
        if block.mark.startswith(ANOTHER):
            if block.mark != ANOTHER:
                self.end()
            return self._start(block)
        if block.mark == "Enter in the other terminal":
            (keyboard,) = (other.stdin for other in self._others)
            assert keyboard is not None
            keyboard.write("\n")
            keyboard.flush()
        ended = subprocess.run(
            ["bash", "-e", "-c", self._moved(block.text)],
            cwd=self._folder,
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )
        return ended.returncode, ended.stdout

    def _start(self, block: Block) -> tuple[int, str]:
        (line,) = self._moved(block.text).splitlines()
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        other = subprocess.Popen(shlex.split(line), cwd=self._folder, env=self._environment, text=True, **pipes)
        self._others.append(other)
        assert other.stdout is not None
        printed = ""
        while not printed.endswith(tuple(f"{ready}\n" for ready in READY)) and (said := other.stdout.readline()):
            printed += said
        return (0 if any(ready in printed for ready in READY) else 1), printed

    def _moved(self, text: str) -> str:
        """To a port that is free."""
        lines = []
        for line in text.replace(PORT, self._port).splitlines():
            if line.startswith("skein sim"):
                line += f" --udp 127.0.0.1:{self._port} --tcp-port 0"
            elif STATION.match(line) and "--connect" not in line:
                line += f" --connect udpin://127.0.0.1:{self._port}"
            lines.append(line)
        return "\n".join(lines) + "\n"


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture(scope="session")
def pages() -> list[Path]:
    """All that is documentation."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@pytest.fixture(scope="session")
def blocks() -> Callable[[Path], list[Block]]:
    return blocks_of


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Where a reader stands: a folder with the scenarios and the docs of the repository in it, to be copied from."""
    for name in ("docs", "missions"):
        (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


@pytest.fixture
def follow(folder: Path, free_port: Callable[[], int]) -> Iterator[Callable[[Path], None]]:
    """Follows a page in `folder`."""
    reader = Reader(folder, free_port())
    yield reader.follow
    reader.end()
