"""A picture of a console, taken by a browser that nobody sees: `make pictures`."""

import asyncio
import shutil
from pathlib import Path

from playwright.async_api import async_playwright

from gcs.console.console import show_recording
from gcs.console.server import close_server, open_server
from gcs.report_page.flown_run import FlownRun
from sitl.services.links import LOOPBACK

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SIZE_PX = {"width": 1280, "height": 760}
DRAWN_S = 20.0
"""Without a graphics card a browser takes its time."""
HIDDEN = ".mantine-Notifications-root { display: none }"
"""It says that there is no graphics card."""


def find_browser() -> str | None:
    """The system's Chromium, or a sibling of it; None without any."""
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


async def take_picture(run: FlownRun, logs: Path, at_s: float, browser: str, path: Path) -> None:
    """Show a flight as it was at some time, and keep what is seen."""
    server = open_server(LOOPBACK, 0, None)
    until = asyncio.Event()
    showing = asyncio.create_task(show_recording(server, run, logs, until, at_s))
    try:
        async with async_playwright() as playwright:
            chromium = await playwright.chromium.launch(
                executable_path=browser, args=["--no-sandbox", "--enable-unsafe-swiftshader"]
            )
            page = await chromium.new_page(viewport=SIZE_PX)  # type: ignore[arg-type]
            await page.goto(f"http://{LOOPBACK}:{server.get_port()}/")
            await page.get_by_role("tab", name="Vehicles").wait_for()
            await page.add_style_tag(content=HIDDEN)
            await page.wait_for_timeout(1000 * DRAWN_S)
            await page.screenshot(path=path)
            await chromium.close()
    finally:
        until.set()
        await showing
        close_server(server)
