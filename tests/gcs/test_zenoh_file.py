"""The file that says how a swarm meets: read, or refused with file, key and reason."""

from pathlib import Path

import pytest

from gcs.zenoh_file import read_zenoh_file
from missions.errors import InputError
from sitl.zenoh_network import ZenohNetwork

GOOD = """
swarm = "field"
router = "tls/10.0.0.1:7447"
ca = "ca.pem"
certificate = "certificates/{name}.pem"
key = "/etc/skein/{name}.key"
"""


def read(folder: Path, text: str) -> ZenohNetwork:
    file = folder / "field.toml"
    file.write_text(text)
    return read_zenoh_file(file)


def test_paths_are_relative_to_the_file(tmp_path: Path) -> None:
    assert read(tmp_path, GOOD) == ZenohNetwork(
        "field",
        "tls/10.0.0.1:7447",
        tmp_path / "ca.pem",
        tmp_path / "certificates" / "{name}.pem",
        Path("/etc/skein/{name}.key"),
    )


def test_certificates_may_be_left_out_where_there_is_no_tls(tmp_path: Path) -> None:
    text = 'swarm = "field"\nrouter = "tcp/127.0.0.1:7447"\n'
    assert read(tmp_path, text) == ZenohNetwork("field", "tcp/127.0.0.1:7447")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('swarm = "field"', "", "field.toml: swarm: is missing"),
        ('"field"', '"a/b"', "swarm: letters, digits"),
        ("tls/10.0.0.1:7447", "10.0.0.1", "router: write tls/HOST:PORT"),
        ("tls/10", "tcp/10", "ca: certificates go with a router at tls/"),
        ('ca = "ca.pem"', "", "router: at tls/... all of ca, certificate, key are needed"),
        ('ca = "ca.pem"', "ca = 3", "ca: must be text in quotes, got 3"),
        ("ca =", "cert =", "cert: no such key; there are swarm, router, ca, certificate, key"),
        ("swarm =", "swarm", "field.toml: .*line 2"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, old: str, new: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(tmp_path, GOOD.replace(old, new, 1))


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none.toml: No such file"):
        read_zenoh_file(tmp_path / "none.toml")
