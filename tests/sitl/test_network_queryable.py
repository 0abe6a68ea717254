"""The network's queryable on a real session: how a vehicle's links stand; disturbances are checked at the door."""

import json
from collections.abc import Iterator
from typing import Any

import pytest
import zenoh

from sitl.config import VehicleConfig
from sitl.endpoint import Endpoint, EndpointConfig
from sitl.formation.correction import Correction
from sitl.network_queryable import serve_network
from sitl.zenoh_session import alive_key, discard_sockets, local_peers, network_key, open_session

FLOWN_TICKS = 10
UNDISTURBED = {"delay_s": 0.0, "loss": 0.0, "from_tick": 0}


class Station:
    """A station beside a vehicle, the lead of the V, that has heard its right neighbour only."""

    def __init__(self, session: zenoh.Session, endpoint: Endpoint) -> None:
        self._session = session
        self._endpoint = endpoint
        self.sysid = endpoint.sysid
        self.neighbours = sorted(endpoint.delays)

    def fly(self, ticks: int) -> None:
        spoken = self.neighbours[0]
        for _ in range(ticks):
            stamp = self._endpoint.observe().tick - self._endpoint.delays[spoken]
            self._endpoint.advance({spoken: Correction(spoken, stamp, stamp, True, 0.0, 0.0)} if stamp >= 0 else {})

    def ask(self, payload: Any = None) -> Any:
        """The answer, or the error as text."""
        if payload is not None and not isinstance(payload, bytes):
            payload = json.dumps(payload)
        (reply,) = self._session.get(network_key("test"), payload=payload)
        return reply.err.payload.to_string() if reply.ok is None else json.loads(reply.ok.payload.to_bytes())


@pytest.fixture
def station(config: VehicleConfig) -> Iterator[Station]:
    peers, station_peer = local_peers([1])
    endpoint = Endpoint(EndpointConfig(vehicle=config))
    with open_session(peers[1]) as vehicle, open_session(station_peer) as session:
        serve_network(vehicle, "test", lambda: {endpoint.sysid: endpoint})
        alive = vehicle.liveliness().declare_token(alive_key("test", endpoint.sysid))
        subscriber = session.liveliness().declare_subscriber(alive_key("test", "*"), history=True)
        subscriber.recv()
        made = Station(session, endpoint)
        made.fly(FLOWN_TICKS)
        yield made
        alive.undeclare()
    endpoint.links.close()
    discard_sockets(peers[1])


@pytest.mark.parametrize("payload", [None, {}])
def test_it_tells_how_the_links_stand(station: Station, payload: Any) -> None:
    heard, *silent = station.neighbours
    links = [{"sender": heard, "receiver": station.sysid, "age_s": 0.2, "used": False, "trust": 0.0}]
    links += [
        {"sender": i, "receiver": station.sysid, "age_s": None, "used": False, "trust": 1.0} for i in silent
    ]  # as long as a first sample may be on its way
    assert station.ask(payload) == {
        "sysid": station.sysid,
        "tick": FLOWN_TICKS,
        "real_time": False,
        "links": links,
        "disturbance": UNDISTURBED,
    }


def test_a_disturbance_is_in_force_from_its_tick_on_rounded_up_to_whole_ticks(station: Station) -> None:
    answer = station.ask({"disturb": {"delay_s": 0.401, "loss": 0.25, "from_tick": FLOWN_TICKS + 5}})
    assert answer["from_tick"] == FLOWN_TICKS + 5
    station.fly(5)
    assert station.ask()["disturbance"] == UNDISTURBED
    station.fly(1)
    assert station.ask()["disturbance"] == {"delay_s": 0.44, "loss": 0.25, "from_tick": FLOWN_TICKS + 5}


def test_without_a_tick_it_counts_from_the_next(station: Station) -> None:
    assert station.ask({"disturb": {"delay_s": 1, "loss": 0}})["from_tick"] == FLOWN_TICKS
    station.fly(1)
    assert station.ask()["disturbance"] == {"delay_s": 1.0, "loss": 0.0, "from_tick": FLOWN_TICKS}
    assert station.ask()["links"][0]["age_s"] == pytest.approx(0.24)


def good(**changes: Any) -> dict[str, Any]:
    return {"disturb": {"delay_s": 1.0, "loss": 0.5, "from_tick": FLOWN_TICKS} | changes}


@pytest.mark.parametrize(
    ("payload", "key"),
    [
        (b"", "Expecting value"),
        (b"\xff", "decode"),
        (b"[" * 100_000, "recursion"),
        ([], "the request: not a JSON object"),
        ({"distrub": {}}, "the request: no key 'distrub'; there are disturb"),
        ({"disturb": None}, "disturb: not a JSON object"),
        (good(delay=1), "disturb: no key 'delay'; there are delay_s, from_tick, loss"),
        ({"disturb": {"loss": 0.0}}, "disturb.delay_s: must be a number from 0 to 60"),
        (good(delay_s=60.1), "disturb.delay_s: must"),
        (good(delay_s=-1), "disturb.delay_s: must"),
        (good(delay_s=float("nan")), "disturb.delay_s: must"),
        (good(delay_s=10**400), "disturb.delay_s: must"),
        (good(delay_s="1"), "disturb.delay_s: must"),
        (good(delay_s=True), "disturb.delay_s: must"),
        (good(loss=1.01), "disturb.loss: must be a number from 0 to 1"),
        (good(loss=float("inf")), "disturb.loss: must"),
        (good(loss=None), "disturb.loss: must"),
        (good(from_tick=-1), "disturb.from_tick: not a tick"),
        (good(from_tick=10.0), "disturb.from_tick: not a tick"),
        (good(from_tick=FLOWN_TICKS - 1), f"disturb.from_tick: {FLOWN_TICKS - 1} is over, it is {FLOWN_TICKS}"),
    ],
)
def test_nonsense_is_answered_with_an_error_and_changes_nothing(station: Station, payload: Any, key: str) -> None:
    error = station.ask(payload)
    assert error.startswith(f"vehicle {station.sysid}: ")
    assert key in error
    station.fly(5)
    assert station.ask()["disturbance"] == UNDISTURBED
