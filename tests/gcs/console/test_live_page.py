"""`skein console SCENARIO` in a browser: three aircraft fly, and whoever looks at the page steers them."""

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect
from pymavlink import mavutil

from gcs.run_folder import RunFolder
from missions.scenario import read_scenario_text

HELD = re.compile("held$")
NEAR_M = 300.0
"""Of home: where RTL circles."""


class Telemetry:
    """What an endpoint says to another station than the console, over its TCP server."""

    def __init__(self, run: Path, sysid: int) -> None:
        addresses = json.loads((run / "endpoints.json").read_text())["vehicles"]
        port = next(one["tcp_port"] for one in addresses if one["sysid"] == sysid)
        scenario, plan = RunFolder(run).read()
        uav = next(uav for uav in plan.uavs if uav.sysid == sysid)
        home = uav.mission.items[0]
        self._frame = scenario.frame
        self._home_m = scenario.frame.from_e7(home.lat_e7, home.lon_e7)
        self._link = mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}")
        self._link.mav.heartbeat_send(6, 8, 0, 0, 0)

    def wait_until(self, distance: Callable[[float], bool]) -> None:
        """Until its distance from home is such, metres."""
        while True:
            message = self._link.recv_match(type="GLOBAL_POSITION_INT", blocking=True, timeout=60.0)
            assert message is not None, "the endpoint says nothing"
            if distance(math.dist(self._frame.from_e7(message.lat, message.lon), self._home_m)):
                return

    def wait_for_mode(self, mode: str) -> None:
        while self._link.flightmode != mode:
            assert self._link.recv_match(type="HEARTBEAT", blocking=True, timeout=60.0) is not None

    def close(self) -> None:
        self._link.close()


def clock_s(page: Page) -> float:
    """The time that is shown."""
    minutes, seconds = page.locator("b", has_text=re.compile(r"^\d+:\d\d\.\d$")).inner_text().split(":")
    return 60.0 * int(minutes) + float(seconds)


def cell(page: Page, sysid: int, column: int) -> Locator:
    return page.locator(f'table.skein tr[data-sysid="{sysid}"] td:nth-child({column})')


def mode_of(page: Page, sysid: int) -> Locator:
    return cell(page, sysid, 2)


def link_of(page: Page, sysid: int) -> Locator:
    return cell(page, sysid, 7)


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).click()


def open_tab(page: Page, name: str) -> None:
    page.get_by_role("tab", name=name).click()


def choose(page: Page, vehicle: str) -> None:
    """In the list of vehicles of the tab that is open."""
    page.get_by_role("combobox", name="Vehicle").click()
    page.get_by_role("option", name=vehicle, exact=True).click()


@pytest.fixture(scope="module")
def trio(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three aircraft of the shipped V, on its whole way: seven minutes of flight."""
    text, _ = read_scenario_text("vee")
    head, *vehicles = re.split(r"(?=\[\[vehicles\]\])", text)
    rest = vehicles[-1].split("# Aerosonde", 1)[1]
    file = tmp_path_factory.mktemp("scenario") / "trio.toml"
    file.write_text(head.replace('name = "vee"', 'name = "trio"') + "".join(vehicles[:3]) + "# Aerosonde" + rest)
    return file


@pytest.mark.timeout(600)  # a whole flight, drawn without a GPU
def test_a_flight_is_seen_and_steered_from_its_page(
    visit: Callable[[str], Page], start_console: Callable[..., Any], trio: Path, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    with start_console(trio, "--out", run, "--speed", 2) as console:
        page = visit(console.address)
        status = page.locator("b + span")

        # They fly.
        expect(page.locator("table.skein tbody td:nth-child(2)")).to_have_text(["AUTO"] * 3)
        expect(cell(page, 1, 4)).to_have_text(re.compile(r"^[23]\d\.\d$"))
        altitude = cell(page, 1, 5).inner_text()
        expect(cell(page, 1, 5)).not_to_have_text(altitude)
        expect(link_of(page, 1)).to_have_text("0.20 s")

        # Their clock is held, and goes on.
        press(page, "Hold")
        expect(status).to_have_text(HELD)
        began_s = clock_s(page)
        assert began_s > 0.0

        # One is chosen; all that takes no simulated time.
        choose(page, "2 left1")
        expect(page.locator("table.skein tr.chosen")).to_have_attribute("data-sysid", "2")
        expect(status).to_have_text(HELD)
        assert clock_s(page) == pytest.approx(began_s, abs=1.0)
        press(page, "Release")
        expect(status).not_to_have_text(HELD)

        # Corrections come a second later, and as before.
        open_tab(page, "Network")
        page.locator("input[inputmode=decimal]:visible").first.fill("1")
        page.locator("input[inputmode=decimal]:visible").first.press("Enter")
        press(page, "Inject")
        expect(page.get_by_text(re.compile("corrections:? 1 s later, 0 % lost"))).to_be_visible()
        open_tab(page, "Vehicles")
        expect(link_of(page, 1)).to_have_text("1.20 s")
        open_tab(page, "Network")
        press(page, "Clear")
        open_tab(page, "Vehicles")
        expect(link_of(page, 1)).to_have_text("0.20 s")

        # The one that is chosen is sent home, and comes home.
        second = Telemetry(run, 2)
        press(page, "10x")
        second.wait_until(lambda distance_m: distance_m > 3.0 * NEAR_M)
        press(page, "RTL")
        expect(mode_of(page, 2)).to_have_text("RTL")
        expect(page.get_by_text("vehicle 2: RTL")).to_be_visible()
        second.wait_for_mode("RTL")
        expect(mode_of(page, 1)).to_have_text("AUTO")
        expect(mode_of(page, 3)).to_have_text("AUTO")
        press(page, "20x")
        second.wait_until(lambda distance_m: distance_m < NEAR_M)
        second.close()
        press(page, "1x")

        # One is killed, once it has been asked whether that is meant.
        open_tab(page, "Network")
        choose(page, "3 right1")
        press(page, "Kill")
        press(page, "Leave it")
        expect(page.get_by_text("Kill vehicle 3?")).to_have_count(0)
        press(page, "Kill")
        press(page, "Kill vehicle 3")
        expect(page.get_by_text("vehicle 3: killed")).to_be_visible()
        open_tab(page, "Vehicles")
        expect(mode_of(page, 3)).to_have_text("lost")
        expect(mode_of(page, 1)).to_have_text("AUTO")

        # All are brought home, likewise.
        press(page, "Abort")
        press(page, "Fly on")
        expect(page.get_by_text("Abort the flight of all vehicles?")).to_have_count(0)
        expect(mode_of(page, 1)).to_have_text("AUTO")
        press(page, "Abort")
        press(page, "Abort, bring all home")
        expect(mode_of(page, 1)).to_have_text("RTL")
        expect(page.get_by_text("flying home (RTL)")).to_be_visible()

        # The flight is ended, likewise, and reported on.
        press(page, "End the flight")
        press(page, "Fly on")
        expect(page.get_by_text("End the flight?")).to_have_count(0)
        press(page, "End the flight")
        page.get_by_role("button", name="End it", exact=True).click(no_wait_after=True)
        code, printed = console.ended()
        page.close()
    assert code == 1, "nobody arrived"
    assert f"Run:     {run}\n" in printed
    metrics = json.loads((run / "metrics.json").read_text())
    assert [vehicle["lost_s"] is not None for vehicle in metrics["vehicles"]] == [False, False, True]
    assert any(event["sysid"] == 2 and "RTL" in event["what"] for event in metrics["events"])
    assert (run / "logs" / "2.tlog").stat().st_size > 0
