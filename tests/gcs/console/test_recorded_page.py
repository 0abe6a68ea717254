"""`skein console RUN` in a browser: a recorded flight that is gone about in."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page, expect


def clock(page: Page) -> Locator:
    """The time that is shown."""
    return page.locator("b", has_text=re.compile(r"^\d+:\d\d\.\d$"))


def modes(page: Page) -> Locator:
    """A cell of each vehicle's row."""
    return page.locator("table.skein tbody td:nth-child(2)")


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).click()


def test_a_recorded_flight_is_played_paused_and_gone_about_in(
    visit: Callable[[str], Page], start_console: Callable[..., Any], flown_path: Path
) -> None:
    with start_console(flown_path) as console:
        page = visit(console.address)
        press(page, "100x")
        expect(modes(page)).to_have_text(["arrived"] * 3)
        names = page.locator("table.skein tbody td:first-child").all_inner_texts()
        assert [name.strip() for name in names] == ["1 lead", "2 left1", "3 right1"]
        expect(page.get_by_text("recorded, paused")).to_be_visible()

        page.get_by_role("slider").first.press("Home")
        expect(clock(page)).to_have_text("0:00.0")
        expect(modes(page)).to_have_text(["AUTO"] * 3)
        press(page, "1x")
        press(page, "Play")
        expect(clock(page)).not_to_have_text("0:00.0")
        press(page, "Pause")

        typed = page.locator("input[inputmode=decimal]").first
        typed.fill("40")
        typed.press("Enter")
        expect(clock(page)).to_have_text("0:40.0")
        page.get_by_role("tab", name="Plots").click()
        expect(page.get_by_text("formation error (m)").first).to_be_visible()
        other = visit(console.address)
        expect(clock(other)).to_have_text("0:40.0")
        expect(clock(page)).to_have_text("0:40.0")

        page.close()
        press(other, "Play")
        expect(clock(other)).not_to_have_text("0:40.0")
