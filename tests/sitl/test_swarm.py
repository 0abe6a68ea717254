"""Endpoints as processes: up together, light, and gone with their swarm or its station."""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from gcs.swarm_clock import SwarmClock
from missions.errors import InputError
from missions.scenario import Scenario
from sitl.reports import Ended
from sitl.swarm import Swarm, SwarmOptions
from sitl.zenoh_session import open_session

OPTIONS = SwarmOptions(seed=1, delay_s=0.2)


def wait_until(condition: Callable[[], bool], timeout_s: float = 20.0) -> None:
    deadline = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.01)


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
        return Path(f"/proc/{pid}/stat").read_text().split()[2] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False


def test_nine_start_answer_at_ports_of_their_own_and_end_as_told(vee: Scenario, tmp_path: Path) -> None:
    with Swarm(vee, SwarmOptions(seed=1, delay_s=0.2, held=False, truth=tmp_path)) as swarm:
        ports = {endpoint.ready.tcp_port for endpoint in swarm.endpoints.values() if endpoint.ready}
        assert len(ports) == 9
        for port in ports:
            socket.create_connection(("127.0.0.1", port), timeout=5).close()
        sockets = Path(swarm.station_peer.connect[0].removeprefix("unixsock-stream/")).parent
        wait_until(lambda: all(file.stat().st_size > 8000 for file in tmp_path.iterdir()))
    assert all(isinstance(endpoint.last, Ended) for endpoint in swarm.endpoints.values())
    assert not any(endpoint.process.is_alive() for endpoint in swarm.endpoints.values())
    assert not sockets.exists()


def test_an_endpoint_loads_nothing_heavy_but_numpy() -> None:
    heavy = {"numba", "scipy", "pydantic", "matplotlib", "pyproj", "rasterio", "typer", "rich", "asyncio"}
    check = f"import sys, sitl.nest; print({heavy} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", check], capture_output=True, text=True).stdout.strip() == "set()"


@pytest.mark.skipif(not Path("/proc/self/smaps_rollup").exists(), reason="the system does not tell")
def test_endpoints_share_most_of_their_memory(vee: Scenario) -> None:
    with Swarm(vee, OPTIONS) as swarm:
        for endpoint in swarm.endpoints.values():
            lines = Path(f"/proc/{endpoint.process.pid}/smaps_rollup").read_text().splitlines()[1:]
            kib = {key: int(value.split()[0]) for key, value in (line.split(":") for line in lines)}
            assert kib["Private_Clean"] + kib["Private_Dirty"] < kib["Rss"] / 3


def test_a_port_in_use_is_named_and_nothing_is_left_running(vee: Scenario) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(InputError, match=rf"vehicle 1: TCP port {port} .*in use"):
            Swarm(vee, SwarmOptions(seed=1, delay_s=0.2, tcp_port=port))


def test_a_killed_endpoint_has_an_obituary_and_the_others_fly_on(vee: Scenario, tmp_path: Path) -> None:
    with Swarm(vee, SwarmOptions(seed=1, delay_s=0.2, held=False, truth=tmp_path)) as swarm:
        victim = swarm.endpoints[4]
        os.kill(victim.process.pid or 0, signal.SIGKILL)
        wait_until(lambda: victim.obituary() is not None)
        assert victim.obituary() == "process killed by SIGKILL"
        assert victim.ready is not None
        assert not listens(victim.ready.tcp_port), "nobody else has its sockets open"
        size = (tmp_path / "1.f64").stat().st_size
        wait_until(lambda: (tmp_path / "1.f64").stat().st_size > size + 100_000)
        assert all(endpoint.obituary() is None for endpoint in swarm.endpoints.values() if endpoint is not victim)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_an_endpoint_that_cannot_write_its_truth_says_why(vee: Scenario, tmp_path: Path) -> None:
    (tmp_path / "5.f64").symlink_to("/dev/full")
    with Swarm(vee, SwarmOptions(seed=1, delay_s=0.2, held=False, truth=tmp_path)) as swarm:
        wait_until(lambda: swarm.endpoints[5].obituary() is not None)
        assert swarm.endpoints[5].obituary() == "vehicle 5: [Errno 28] No space left on device"
        assert all(endpoint.obituary() is None for sysid, endpoint in swarm.endpoints.items() if sysid != 5)


def test_a_killed_endpoints_socket_is_removed(vee: Scenario) -> None:
    with Swarm(vee, OPTIONS) as swarm:
        folder = Path(swarm.station_peer.connect[0].removeprefix("unixsock-stream/")).parent
        os.kill(swarm.endpoints[2].process.pid or 0, signal.SIGKILL)
    assert not folder.exists()


def test_an_endpoint_that_someone_terminates_is_lost(vee: Scenario) -> None:
    with Swarm(vee, OPTIONS) as swarm:
        os.kill(swarm.endpoints[6].process.pid or 0, signal.SIGTERM)
        wait_until(lambda: swarm.endpoints[6].obituary() is not None)
        assert swarm.endpoints[6].obituary() == "process ended at tick 0, though nobody had stopped its clock"


@pytest.mark.parametrize("held", [True, False])
def test_endpoints_end_in_good_order_when_their_station_is_killed(tmp_path: Path, held: bool) -> None:
    """The station is a process of its own, killed without a chance to clean up."""
    script = tmp_path / "station.py"
    script.write_text(
        "import time\n"
        "if __name__ == '__main__':\n"
        "    from missions.scenario import load_scenario\n"
        "    from sitl.swarm import Swarm, SwarmOptions\n"
        f"    swarm = Swarm(load_scenario('vee'), SwarmOptions(seed=1, delay_s=0.2, held={held}))\n"
        "    print(*[e.process.pid for e in swarm.endpoints.values()], swarm.station_peer.connect[0], flush=True)\n"
        "    time.sleep(600)\n"
    )
    station = subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True)
    assert station.stdout is not None
    *pids, address = station.stdout.readline().split()
    assert len(pids) == 9
    station.kill()
    station.wait()
    station.stdout.close()
    wait_until(lambda: not any(alive(int(pid)) for pid in pids))
    wait_until(lambda: not Path(address.removeprefix("unixsock-stream/")).parent.exists())


def test_a_vehicle_that_fails_is_named_and_those_in_its_process_fly_on(vee: Scenario, tmp_path: Path) -> None:
    options = replace(OPTIONS, held=True, truth=tmp_path, count=3, per_process=3)
    (tmp_path / "2.f64").symlink_to("/dev/full")
    with Swarm(vee, options) as swarm, open_session(swarm.station_peer) as session:
        SwarmClock(session, swarm.name, swarm.endpoints).release(swarm.endpoints)
        assert len({endpoint.process.pid for endpoint in swarm.endpoints.values()}) == 1
        failed = swarm.endpoints[2]
        wait_until(lambda: failed.obituary() is not None)
        assert failed.obituary() == "vehicle 2: [Errno 28] No space left on device"
        size = (tmp_path / "1.f64").stat().st_size
        wait_until(lambda: (tmp_path / "1.f64").stat().st_size > size + 100_000)
        assert swarm.endpoints[1].obituary() is swarm.endpoints[3].obituary() is None
        assert failed.ready is not None
        port = failed.ready.tcp_port
        wait_until(lambda: not listens(port))
    assert isinstance(swarm.endpoints[3].last, Ended)


def listens(port: int) -> bool:
    try:
        socket.create_connection(("127.0.0.1", port), timeout=5).close()
    except ConnectionRefusedError:
        return False
    return True


def test_one_that_cannot_start_is_named_among_those_of_its_process(vee: Scenario, tmp_path: Path) -> None:
    (tmp_path / "2").mkdir()
    (tmp_path / "2" / "signing").write_bytes(b"not what was written")
    with pytest.raises(InputError, match=r"^vehicle 2: .*/2/signing: damaged"):
        Swarm(vee, replace(OPTIONS, count=3, per_process=3, memory=tmp_path))


def test_a_killed_endpoint_can_be_started_again_and_catches_up_with_the_others(vee: Scenario, tmp_path: Path) -> None:
    with Swarm(vee, replace(OPTIONS, held=False, truth=tmp_path, count=3, memory=tmp_path)) as swarm:
        victim = swarm.endpoints[2]
        os.kill(victim.process.pid or 0, signal.SIGKILL)
        wait_until(lambda: victim.obituary() is not None)
        start = ticks_flown(tmp_path / "1.f64")
        swarm.restart(2, start)
        assert swarm.endpoints[2].obituary() is None
        met = ticks_flown(tmp_path / "1.f64") + 10_000
        wait_until(lambda: start + ticks_flown(tmp_path / "2.f64") > met)
    ends = [endpoint.last.tick for endpoint in swarm.endpoints.values() if isinstance(endpoint.last, Ended)]
    assert len(ends) == 3
    assert max(ends) - min(ends) <= 5 * 5, "in lockstep again"


def ticks_flown(truth: Path) -> int:
    return truth.stat().st_size // 48


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="the system does not tell")
def test_more_than_a_nest_holds_are_forked_from_several(vee: Scenario, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sitl.swarm.MOST_IN_A_NEST", 4)
    with Swarm(vee, replace(OPTIONS, per_process=2)) as swarm:
        pids = {endpoint.process.pid for endpoint in swarm.endpoints.values()}
        nests = {Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1] for pid in pids}
        assert (len(pids), len(nests)) == (5, 3)


def test_vehicles_beyond_the_scenarios_fly_too(vee: Scenario) -> None:
    with Swarm(vee, replace(OPTIONS, count=30, sysid_base=101, per_process=15)) as swarm:
        assert list(swarm.endpoints) == list(range(101, 131))
        assert len({endpoint.process.pid for endpoint in swarm.endpoints.values()}) == 2
