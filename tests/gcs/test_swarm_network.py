"""The links of real processes, seen and disturbed while they run; a disturbed flight repeats."""

import asyncio
import os
import signal
import struct
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
import zenoh

from gcs.flight import FlightOptions, fly
from gcs.run_folder import make_run_folder
from gcs.swarm_clock import SwarmClock
from gcs.swarm_network import LinkState, SwarmNetwork
from missions.errors import InputError
from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan
from sitl.swarm import Swarm, SwarmOptions
from sitl.zenoh_session import network_key, open_session

OPTIONS = SwarmOptions(seed=1, delay_s=0.2, count=3, held=False)
ROW = struct.Struct("<6d")


def wait_until(condition: Callable[[], bool], timeout_s: float = 20.0) -> None:
    deadline = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.01)


@pytest.fixture(scope="module")
def vee() -> Scenario:
    return load_scenario("vee")


Running = tuple[Swarm, SwarmNetwork, zenoh.Session]


@pytest.fixture
def running(vee: Scenario, request: pytest.FixtureRequest) -> Iterator[Running]:
    """Three on the ground, their clocks running."""
    options = replace(OPTIONS, **getattr(request, "param", {}))
    with Swarm(vee, options) as swarm, open_session(swarm.station_peer) as session:
        clock = SwarmClock(session, swarm.name, swarm.endpoints)
        if options.real_time:
            clock.start(swarm.endpoints)
        yield swarm, SwarmNetwork(session, swarm.name), session


def ages(links: Iterable[LinkState]) -> set[float]:
    return {round(link.age_s, 6) for link in links if link.age_s is not None}


def in_force(session: zenoh.Session, swarm: Swarm) -> list[object]:
    replies = session.get(
        network_key(swarm.name), target=zenoh.QueryTarget.ALL, consolidation=zenoh.ConsolidationMode.NONE
    )
    return [reply.ok.payload.to_string().partition('"disturbance": ')[2] for reply in replies]


@pytest.mark.parametrize("running", [{}, {"per_process": 3}], indirect=True)
def test_ages_rise_by_what_is_added_and_fall_back_and_all_count_from_one_tick(running: Running) -> None:
    swarm, network, session = running
    everyone = swarm.sysids
    wait_until(lambda: ages(network.links(everyone)) == {0.2})
    links = network.links(everyone)
    assert [(link.receiver, link.sender) for link in links] == [(1, 2), (1, 3), (2, 1), (2, 3), (3, 1), (3, 2)]
    assert not any(link.used for link in links), "on the ground"
    for delay_s, added_s in ((1.5, 1.52), (0.0, 0.0), (0.39, 0.4)):
        tick = network.disturb(delay_s, 0.0, everyone)
        wait_until(lambda added_s=added_s: ages(network.links(everyone)) == {round(0.2 + added_s, 6)})  # type: ignore[misc]
        (told,) = set(in_force(session, swarm))
        assert f'"from_tick": {tick}}}' in str(told), "all count from one tick, at full speed"


def test_losses_let_samples_age(running: Running) -> None:
    swarm, network, _ = running
    network.disturb(0.0, 1.0, swarm.sysids)
    wait_until(lambda: min(ages(network.links(swarm.sysids))) > 10.0)
    network.disturb(0.0, 0.0, swarm.sysids)
    wait_until(lambda: ages(network.links(swarm.sysids)) == {0.2})


def test_links_to_who_is_gone_are_left_out_at_once_and_disturbing_it_names_it(running: Running) -> None:
    swarm, network, _ = running
    os.kill(swarm.endpoints[2].process.pid or 0, signal.SIGKILL)
    wait_until(lambda: {link.receiver for link in network.links(swarm.sysids)} == {1, 3})
    with pytest.raises(InputError, match=r"vehicles \[2\]"):
        network.disturb(1.0, 0.0, swarm.sysids)
    network.disturb(1.0, 0.0, [1, 3])
    wait_until(lambda: {link.age_s for link in network.links([1]) if link.sender == 3} == {1.2})


def test_who_has_been_stopped_is_named_and_the_others_fly_on(running: Running, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gcs.swarm_network.DISTURB_TIMEOUT_S", 1.5)
    swarm, network, _ = running
    pid = swarm.endpoints[2].process.pid or 0
    os.kill(pid, signal.SIGSTOP)
    try:
        wait_until(lambda: {link.receiver for link in network.links(swarm.sysids)} == {1, 3})
        with pytest.raises(InputError, match=r"vehicles \[2\] did not answer within 1.5 s"):
            network.disturb(1.0, 0.0, swarm.sysids)
    finally:
        monkeypatch.undo()
        os.kill(pid, signal.SIGCONT)
    wait_until(lambda: len(network.links(swarm.sysids)) == 6)
    network.disturb(1.0, 0.0, swarm.sysids)
    wait_until(lambda: ages(network.links(swarm.sysids)) == {1.2})


def test_what_is_refused_is_told_and_the_swarm_flies_on(running: Running) -> None:
    swarm, network, _ = running
    wait_until(lambda: ages(network.links(swarm.sysids)) == {0.2})
    for delay_s, loss, from_tick, why in (
        (100.0, 0.0, None, "disturb.delay_s: must be a number from 0 to 60"),
        (float("nan"), 0.0, None, "disturb.delay_s: must"),
        (1.0, 1.5, None, "disturb.loss: must be a number from 0 to 1"),
        (1.0, 0.5, 0, "disturb.from_tick: 0 is over"),
    ):
        with pytest.raises(InputError, match=rf"vehicle \d: {why}"):
            network.disturb(delay_s, loss, swarm.sysids, from_tick)
    network.disturb(1.0, 0.0, swarm.sysids)
    wait_until(lambda: ages(network.links(swarm.sysids)) == {1.2})


@pytest.mark.parametrize("running", [{"held": True, "real_time": True, "speed": 10.0}], indirect=True)
def test_in_real_time_too_ages_rise_and_fall_back(running: Running) -> None:
    swarm, network, _ = running
    wait_until(lambda: len(ages(network.links(swarm.sysids))) > 0)
    network.disturb(5.0, 0.0, swarm.sysids)
    wait_until(lambda: min(ages(network.links(swarm.sysids))) >= 5.2)
    network.disturb(0.0, 0.0, swarm.sysids)
    wait_until(lambda: max(ages(network.links(swarm.sysids))) < 5.0)


@pytest.mark.parametrize("running", [{"held": True}], indirect=True)
def test_a_swarm_that_is_held_stays_held(running: Running) -> None:
    swarm, network, session = running
    assert network.disturb(1.0, 0.0, swarm.sysids) == 1
    assert network.links(swarm.sysids) == network.links(swarm.sysids)
    assert ages(network.links(swarm.sysids)) == set(), "nothing has been heard, since nothing has begun"
    SwarmClock(session, swarm.name, swarm.endpoints).release(swarm.endpoints)
    wait_until(lambda: ages(network.links(swarm.sysids)) == {1.2})


FROM_TICK = 500


def flown(
    folder: Path, scenario: Scenario, text: str, planned: FormationPlan, disturbance: tuple[float, float] | None
) -> dict[str, list[tuple[float, ...]]]:
    """The truth of a flight, as far as all fly."""

    class DisturbingClock(SwarmClock):
        """Lets the clock go once the disturbance has been told."""

        def release(self, sysids: Iterable[int]) -> None:
            if disturbance is not None:
                network = SwarmNetwork(self._session, self._key.split("/")[1])
                assert network.disturb(*disturbance, sysids, FROM_TICK) == FROM_TICK
            super().release(sysids)

    run = make_run_folder(folder, scenario.name)
    run.write_plan(text, scenario, planned)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("gcs.flight.SwarmClock", DisturbingClock)
        record = asyncio.run(fly(scenario, planned, run, FlightOptions(delay_s=0.2), lambda _: None, lambda _: None))
    assert record.lost == {}
    rows = int(min(one.duration_s for one in planned.references(scenario).values()) / 0.04)
    return {
        file.name: list(ROW.iter_unpack(file.read_bytes()[: rows * ROW.size])) for file in sorted(run.truth.iterdir())
    }


def test_the_same_disturbance_at_the_same_tick_is_the_same_flight(
    short_scenario: Path, short: Scenario, short_plan: FormationPlan, tmp_path: Path
) -> None:
    text = short_scenario.read_text()
    calm, first, second = (
        flown(tmp_path / name, short, text, short_plan, disturbance)
        for name, disturbance in (("calm", None), ("first", (1.0, 0.3)), ("second", (1.0, 0.3)))
    )
    assert first == second
    for name, rows in first.items():
        begun = FROM_TICK + 1  # what is decided at a tick moves the aircraft to where it is at the next
        assert rows[:begun] == calm[name][:begun]
        assert rows[begun:] != calm[name][begun:]
