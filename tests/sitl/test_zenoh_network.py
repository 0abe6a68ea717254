"""A swarm at a router with certificates: vehicles hear each other, strangers neither hear nor are heard."""

import queue
import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import pytest
import zenoh

from missions.errors import InputError
from sitl.zenoh_network import STATION, ZenohNetwork, vehicle_name
from sitl.zenoh_session import alive_key, clock_key, correction_key, open_session

SWARM = "field"
PATIENCE_S = 20.0
needs_openssl = pytest.mark.skipif(shutil.which("openssl") is None, reason="needs openssl to make certificates")


def openssl(*arguments: object, folder: Path) -> None:
    subprocess.run(["openssl", *map(str, arguments)], cwd=folder, check=True, capture_output=True)


def make_ca(folder: Path, name: str) -> None:
    key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout", f"{name}.key")
    openssl("req", "-x509", *key, "-out", f"{name}.pem", "-subj", f"/CN={name}", "-days", 2, folder=folder)


def make_certificate(folder: Path, name: str, ca: str) -> None:
    key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout", f"{name}.key")
    openssl("req", *key, "-out", f"{name}.csr", "-subj", f"/CN={name}", folder=folder)
    (folder / "ext").write_text("subjectAltName=IP:127.0.0.1\nbasicConstraints=CA:FALSE\n")
    signed_by = ("-CA", f"{ca}.pem", "-CAkey", f"{ca}.key", "-CAcreateserial")
    openssl(
        "x509", "-req", "-in", f"{name}.csr", *signed_by, "-out", f"{name}.pem", "-days", 2, "-extfile", "ext",
        folder=folder,
    )  # fmt: skip


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of a router, a station and vehicles 1 to 3; vehicle 4's is signed by somebody else."""
    folder = tmp_path_factory.mktemp("certificates")
    for ca in ("ca", "other-ca"):
        make_ca(folder, ca)
    for name in ("router", "station", "visitor", *map(vehicle_name, (1, 2, 3))):
        make_certificate(folder, name, "ca")
    make_certificate(folder, vehicle_name(4), "other-ca")
    return folder


@pytest.fixture(scope="module")
def network(certificates: Path, free_port: Callable[[], int]) -> Iterator[ZenohNetwork]:
    """With its router running."""
    network = ZenohNetwork(
        SWARM,
        f"tls/127.0.0.1:{free_port()}",
        certificates / "ca.pem",
        certificates / "{name}.pem",
        certificates / "{name}.key",
    )
    with open_session(network.server()):
        yield network


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Routers that are not there are not looked for for long."""
    monkeypatch.setattr("sitl.zenoh_session.ROUTER_TIMEOUT_MS", 1000)


@pytest.fixture
def join(network: ZenohNetwork) -> Iterator[Callable[[str], zenoh.Session]]:
    """Opens the session of whoever has a certificate."""
    with ExitStack() as stack:
        yield lambda name: stack.enter_context(open_session(network.client(name), real_time=True))


Heard = queue.SimpleQueue[tuple[str, bytes]]
Join = Callable[[str], zenoh.Session]


def listen(session: zenoh.Session, key: str) -> Heard:
    heard: Heard = queue.SimpleQueue()

    def put(sample: zenoh.Sample) -> None:
        heard.put((str(sample.key_expr), sample.payload.to_bytes()))

    session.declare_subscriber(key, zenoh.handlers.Callback(put, indirect=False))
    return heard


def watch(session: zenoh.Session) -> queue.SimpleQueue[str]:
    """Whose liveliness tokens a session sees."""
    seen: queue.SimpleQueue[str] = queue.SimpleQueue()
    session.liveliness().declare_subscriber(
        alive_key(SWARM, "*"),
        zenoh.handlers.Callback(lambda s: seen.put(str(s.key_expr)), indirect=False),
        history=True,
    )
    return seen


def heard_until(heard: Heard, last: bytes, say: Callable[[], None]) -> list[bytes]:
    """What is heard until something is, which is said until then: nobody knows when a subscription is known."""
    found: list[bytes] = []
    for _ in range(round(PATIENCE_S / 0.05)):
        say()
        try:
            found.append(heard.get(timeout=0.05)[1])
        except queue.Empty:
            continue
        if found[-1] == last:
            return found
    raise AssertionError(f"{last!r} was not heard")


@needs_openssl
def test_vehicles_hear_each_other_and_see_who_is_there(join: Join) -> None:
    first, second = join(vehicle_name(1)), join(vehicle_name(2))
    token = first.liveliness().declare_token(alive_key(SWARM, 1))
    assert watch(second).get(timeout=PATIENCE_S) == alive_key(SWARM, 1)
    heard = listen(second, correction_key(SWARM, 1))
    assert heard_until(heard, b"mine", lambda: first.put(correction_key(SWARM, 1), b"mine")) == [b"mine"]
    token.undeclare()


@needs_openssl
@pytest.mark.parametrize("who", ["visitor", vehicle_name(3), STATION])
def test_nobody_can_speak_in_a_vehicles_name(join: Join, who: str) -> None:
    first, second, other = join(vehicle_name(1)), join(vehicle_name(2)), join(who)
    heard = listen(second, correction_key(SWARM, 1))

    def say() -> None:
        other.put(correction_key(SWARM, 1), b"forged")
        first.put(correction_key(SWARM, 1), b"mine")

    assert heard_until(heard, b"mine", say) == [b"mine"]
    for _ in range(20):  # whatever was forged before is older than this
        say()
    assert b"forged" not in {heard.get(timeout=PATIENCE_S)[1] for _ in range(20)}


@needs_openssl
def test_who_is_none_of_the_swarm_hears_and_sees_nothing(join: Join) -> None:
    first, second, visitor = join(vehicle_name(1)), join(vehicle_name(2)), join("visitor")
    overheard, seen = listen(visitor, "**"), watch(visitor)
    token = first.liveliness().declare_token(alive_key(SWARM, 1))
    heard, watched = listen(second, correction_key(SWARM, 1)), watch(second)
    for number in range(20):
        word = b"word %d" % number
        heard_until(heard, word, lambda word=word: first.put(correction_key(SWARM, 1), word))  # type: ignore[misc]
    assert watched.get(timeout=PATIENCE_S) == alive_key(SWARM, 1)
    assert overheard.empty()
    assert seen.empty()
    token.undeclare()


@needs_openssl
def test_the_station_alone_asks_the_clocks(join: Join) -> None:
    vehicle, station = join(vehicle_name(1)), join(STATION)
    asked: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def answer(query: zenoh.Query) -> None:
        asked.put(query.payload.to_bytes() if query.payload else b"")
        query.reply(clock_key(SWARM), b"done")

    vehicle.declare_queryable(clock_key(SWARM), zenoh.handlers.Callback(answer, indirect=False))
    for _ in range(100):
        replies = list(station.get(clock_key(SWARM), payload=b"release", timeout=2.0))
        if replies:
            break
    assert [reply.ok.payload.to_bytes() for reply in replies] == [b"done"]
    for name in ("visitor", vehicle_name(2)):
        assert list(join(name).get(clock_key(SWARM), payload=b"forged", timeout=1.0)) == []
    assert {asked.get() for _ in range(asked.qsize())} == {b"release"}


@needs_openssl
def test_a_certificate_of_anothers_is_refused_with_an_error_that_says_so(network: ZenohNetwork) -> None:
    with pytest.raises(InputError, match=r"router tls/127.*does not accept .*vehicle-4.pem"):
        open_session(network.client(vehicle_name(4)))


@needs_openssl
def test_a_router_of_anothers_is_refused_with_an_error_that_says_so(network: ZenohNetwork, certificates: Path) -> None:
    elsewhere = replace(network, ca=certificates / "other-ca.pem")
    with pytest.raises(InputError, match=r"its certificate is not signed by .*other-ca.pem"):
        open_session(elsewhere.client(vehicle_name(4)))


@needs_openssl
def test_files_that_do_not_fit_or_are_missing_are_named(network: ZenohNetwork, certificates: Path) -> None:
    with pytest.raises(InputError, match=r"vehicle-1.pem and .*vehicle-2.key do not fit each other"):
        replace(network, key=certificates / "vehicle-2.key").client(vehicle_name(1))
    with pytest.raises(InputError, match=r"vehicle-99.pem: no such file"):
        network.client(vehicle_name(99))
    with pytest.raises(InputError, match=r"router.key: no certificate in PEM"):
        replace(network, ca=certificates / "router.key").client(vehicle_name(1))


def test_where_no_router_is_the_error_says_so(free_port: Callable[[], int]) -> None:
    network = ZenohNetwork(SWARM, f"tcp/127.0.0.1:{free_port()}")
    with pytest.raises(InputError, match="no router answers there"):
        open_session(network.client(vehicle_name(1)))
