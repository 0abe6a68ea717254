"""The ports of several swarms on one machine."""

import contextlib
import socket

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.sim_ports import (
    LAST_INSTANCE,
    TCP_STEP,
    UDP_INSTANCE_STEP,
    parse_station,
    require_free_tcp,
    tcp_base,
    udp_port,
)
from missions.errors import InputError

INSTANCES = range(LAST_INSTANCE + 1)
MOST_VEHICLES = 250
FIRST_EPHEMERAL = 32768
"""Linux gives the ports from here on to whoever asks for any."""


def test_instances_share_no_port_however_many_vehicles_they_have() -> None:
    tcp = [tcp_base(k) + TCP_STEP * i for k in INSTANCES for i in range(MOST_VEHICLES)]
    udp = [udp_port(k) + i for k in INSTANCES for i in range(UDP_INSTANCE_STEP)]
    assert len(set(tcp)) == len(tcp)
    assert len(set(udp)) == len(udp)
    assert max(tcp + udp) < FIRST_EPHEMERAL


def test_the_first_instance_is_where_stations_look() -> None:
    assert (tcp_base(0), udp_port(0)) == (5760, 14550)


def test_a_port_that_is_taken_is_named_whichever_vehicle_s_it_is() -> None:
    with contextlib.closing(socket.create_server(("127.0.0.1", 0))) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(InputError, match=rf"^TCP port {port}: .*in use.*--instance 1"):
            require_free_tcp(port - TCP_STEP, 2)


def test_ports_beyond_the_last_are_refused_before_any_is_tried() -> None:
    with pytest.raises(InputError, match=r"^--tcp-port 65530: 2 vehicles would need ports up to 65540"):
        require_free_tcp(65530, 2)


@given(st.integers(1, 65535), st.integers(0, 255))
def test_stations_on_this_machine_are_taken(port: int, last: int) -> None:
    assert parse_station(f"127.0.0.{last}:{port}") == (f"127.0.0.{last}", port)
    assert parse_station(f"localhost:{port}") == parse_station(f":{port}") == ("127.0.0.1", port)
    assert parse_station(str(port)) == ("127.0.0.1", port)


@pytest.mark.parametrize("text", ["", "127.0.0.1", "host:14550", "127.0.0.1:", "127.0.0.1:x", "[::1]:14550", "1.2.3:4"])
def test_what_is_no_address_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(InputError, match=r"^--udp .*: give HOST:PORT, as in 127\.0\.0\.1:14550"):
        parse_station(text)


@pytest.mark.parametrize("port", ["0", "-1", "65536"])
def test_ports_that_there_are_not_are_refused(port: str) -> None:
    with pytest.raises(InputError, match="1 to 65535"):
        parse_station(f"127.0.0.1:{port}")


@pytest.mark.parametrize("host", ["10.0.0.1", "0.0.0.0", "255.255.255.255"])
def test_nothing_is_sent_to_other_machines(host: str) -> None:
    with pytest.raises(InputError, match="on this machine only"):
        parse_station(f"{host}:14550")
