"""Runs to look at, servers to look at them with, and browsers: the system's Chromium, headless, by Playwright."""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
import viser
from playwright.sync_api import Browser, Page, expect, sync_playwright

from gcs.console.server import close_server, open_server
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report import write_report
from gcs.report_page import FlownRun, read_flown_run
from gcs.run_folder import make_run_folder
from gcs.truth import write_truths
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

LOOPBACK = "127.0.0.1"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
REQUIRED = "SKEIN_BROWSER"
"""An environment variable: with the value `required` a machine without a browser fails, instead of skipping."""
ARGUMENTS = ("--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-sync")
"""It draws without a GPU, and talks to nobody but the console."""
VIEWPORT: Any = {"width": 900, "height": 600}
PATIENCE_S = 120.0
"""For whatever a page is to show: machines without a GPU are slow, and shared."""


@pytest.fixture(scope="session")
def keep_run(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Flies a plan by rehearsal and keeps the run."""

    def keep(scenario: Scenario, text: str, plan: FormationPlan) -> Path:
        run = make_run_folder(tmp_path_factory.mktemp("flown") / scenario.name, scenario.name)
        run.write_plan(text, scenario, plan)
        run.begin_flight()
        truths, record = rehearse_plan(scenario, plan, RehearsalOptions(7, 0.2))
        write_truths(truths, run.truth)
        write_report(run, scenario, plan, record)
        return run.path

    return keep


@pytest.fixture(scope="session")
def flown_path(keep_run: Callable[..., Path], short: Scenario, short_scenario: Path, short_plan: FormationPlan) -> Path:
    """The short scenario, flown."""
    return keep_run(short, short_scenario.read_text(), short_plan)


@pytest.fixture(scope="session")
def flown(flown_path: Path) -> FlownRun:
    return read_flown_run(flown_path)


@pytest.fixture(scope="module")
def serve_pages() -> Iterator[Callable[..., viser.ViserServer]]:
    """Opens servers, on a free port unless told otherwise."""
    with ExitStack() as stack:

        def open_one(host: str = LOOPBACK, port: int = 0, token: str | None = None) -> Any:
            server = open_server(host, port, token)
            stack.callback(close_server, server)
            return server

        yield open_one


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A browser, where there is one."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        reason = f"no browser: none of {', '.join(BROWSERS)} is on PATH; on Debian, apt-get install chromium"
        if os.environ.get(REQUIRED) == "required":
            pytest.fail(reason)
        pytest.skip(reason)
    expect.set_options(timeout=PATIENCE_S * 1000.0)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=found, args=ARGUMENTS, timeout=PATIENCE_S * 1000.0, chromium_sandbox=False
        )
        yield browser
        browser.close()


@dataclass(frozen=True)
class Console:
    """A running `skein console`.

    Attributes:
        process: its own.
        address: of its page, as it has printed it.
    """

    process: subprocess.Popen[str]
    address: str

    def ended(self) -> tuple[int, str]:
        """Its exit code, once it has come to its end, and what it has printed after the address."""
        out, _ = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode, out


@pytest.fixture(scope="module")
def start_console(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Any]:
    """Commands, as contexts; Ctrl-C ends those that have not ended."""

    @contextmanager
    def start(*arguments: object) -> Iterator[Console]:
        process = subprocess.Popen(
            [sys.executable, "-m", "gcs.main", "console", *map(str, arguments), "--port", "0"],
            stdout=subprocess.PIPE,
            text=True,
            env=os.environ | {"XDG_STATE_HOME": str(tmp_path_factory.mktemp("state"))},
        )
        assert process.stdout is not None
        try:
            address = next(filter(None, (re.search(r"http://\S+", line) for line in process.stdout)))[0]
            yield Console(process, address)
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=PATIENCE_S)

    return start


@pytest.fixture
def visit(browser: Browser) -> Iterator[Callable[[str], Page]]:
    """Opens pages. In the end none of them has had an error, or asked for anything from elsewhere."""
    wrong: list[str] = []
    with ExitStack() as stack:

        def open_page(address: str) -> Page:
            page = stack.enter_context(browser.new_page(viewport=VIEWPORT))
            page.set_default_timeout(PATIENCE_S * 1000.0)
            own = urlsplit(address).netloc

            def judge(url: str) -> None:
                parts = urlsplit(url)
                if parts.scheme not in ("data", "blob") and parts.netloc != own:
                    wrong.append(f"asked for {url}")

            page.on("request", lambda request: judge(request.url))
            page.on("websocket", lambda socket: judge(socket.url))
            page.on("requestfailed", lambda request: wrong.append(f"failed: {request.url} {request.failure}"))
            page.on("pageerror", lambda error: wrong.append(f"error: {error}"))
            page.on("console", lambda line: wrong.append(f"console: {line.text}") if line.type == "error" else None)
            page.goto(address)
            return page

        yield open_page
        assert wrong == []
