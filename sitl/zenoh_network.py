"""A swarm's Zenoh sessions over several machines: clients of one router, each with a certificate of its own."""

from dataclasses import dataclass
from pathlib import Path

from missions.errors import InputError
from sitl.zenoh_session import Peer, clock_key, network_key
from sitl.zenoh_tls import Tls

STATION = "station"
ROUTER = "router"
SYSIDS = range(1, 251)
_NAME = "{name}"
_READ = ("put", "declare_subscriber", "liveliness_token", "query", "reply", "declare_queryable")
_ASK = ("declare_subscriber", "declare_liveliness_subscriber", "liveliness_query")


@dataclass(frozen=True)
class ZenohNetwork:
    """How a swarm meets.

    Attributes:
        swarm: its name in all keys, the same on all machines.
        router: where the router listens, as a Zenoh endpoint ("tls/10.0.0.1:7447", "tcp/...").
        ca: certificate that signed those of all; None for no certificates.
        certificate, key: path of each one's, with {name} for the name of whose it is: vehicle-3, station, router.
    """

    swarm: str
    router: str
    ca: Path | None = None
    certificate: Path | None = None
    key: Path | None = None

    def client(self, name: str) -> Peer:
        """The session of a vehicle or the station. Raises InputError when its certificate cannot be used."""
        return Peer((), (self.router,), mode="client", tls=self._tls(name))

    def server(self) -> Peer:
        """The router's session. Raises InputError as `client`."""
        access = access_control(self.swarm) if self.ca is not None else None
        return Peer((self.router,), (), mode="router", tls=self._tls(ROUTER), access_control=access)

    def _tls(self, name: str) -> Tls | None:
        if self.ca is None:
            return None
        if self.certificate is None or self.key is None:
            raise InputError("a ca needs a certificate and a key")
        own = (Path(str(path).replace(_NAME, name)) for path in (self.certificate, self.key))
        tls = Tls(self.ca, *own)
        tls.context()
        return tls


def vehicle_name(sysid: int) -> str:
    """Common name in a vehicle's certificate."""
    return f"vehicle-{sysid}"


def access_control(swarm: str) -> dict[str, object]:
    """The router's rules: who is a vehicle of the swarm hears all of it and speaks for itself alone; the station hears
    all and asks clocks and links; everybody else neither hears nor is heard."""
    everything, asked = f"skein/{swarm}/**", (clock_key(swarm), network_key(swarm))
    rules = [
        _rule("hear", _READ, "egress", everything),
        _rule("ask", _ASK, "ingress", everything),
        _rule("answer", ("declare_queryable", "reply"), "ingress", *asked),
        _rule("command", ("query",), "ingress", *asked),
        *(_rule(f"say-{i}", ("put", "liveliness_token"), "ingress", f"skein/{swarm}/{i}/*") for i in SYSIDS),
    ]
    names = {i: vehicle_name(i) for i in SYSIDS}
    subjects = [{"id": name, "cert_common_names": [name]} for name in (STATION, *names.values())]
    policies = [
        {"rules": ["hear", "ask", "command"], "subjects": [STATION]},
        *({"rules": ["hear", "ask", "answer", f"say-{i}"], "subjects": [name]} for i, name in names.items()),
    ]
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": rules,
        "subjects": subjects,
        "policies": policies,
    }


def _rule(name: str, messages: tuple[str, ...], flow: str, *keys: str) -> dict[str, object]:
    return {"id": name, "messages": list(messages), "flows": [flow], "permission": "allow", "key_exprs": list(keys)}
