"""Keys from files, in every form."""

import base64
import hashlib
from pathlib import Path

import pytest

from gcs.signing_key import make_signing_key, read_signing_key
from missions.errors import InputError

KEY = bytes(range(100, 132))


@pytest.mark.parametrize(
    ("content", "key"),
    [
        (KEY, KEY),
        (bytes(range(32)), bytes(range(32))),
        (KEY.hex().encode() + b"\n", KEY),
        (base64.b64encode(KEY) + b"\n", KEY),
        (b"correct horse battery staple\n", hashlib.sha256(b"correct horse battery staple").digest()),
        (b"a passphrase of thirty-two bytes", hashlib.sha256(b"a passphrase of thirty-two bytes").digest()),
        (b"cafe", hashlib.sha256(b"cafe").digest()),
    ],
)
def test_a_key_may_be_written_in_several_ways(tmp_path: Path, content: bytes, key: bytes) -> None:
    file = tmp_path / "key"
    file.write_bytes(content)
    assert read_signing_key(file, lambda text: None) == key


@pytest.mark.parametrize("content", [b"", b" \n", bytes(32), b"0" * 64])
def test_nothing_is_no_key(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "key").write_bytes(content)
    with pytest.raises(InputError, match="no signing key in it"):
        read_signing_key(tmp_path / "key", lambda text: None)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"key: No such file"):
        read_signing_key(tmp_path / "key", lambda text: None)


def test_a_key_that_all_can_read_is_warned_of(tmp_path: Path) -> None:
    file = tmp_path / "key"
    warnings: list[str] = []
    file.write_bytes(KEY)
    for mode, count in ((0o600, 0), (0o644, 1)):
        file.chmod(mode)
        read_signing_key(file, warnings.append)
        assert len(warnings) == count


def test_a_new_key_is_random_and_its_owner_s_alone(tmp_path: Path) -> None:
    warnings: list[str] = []
    keys = set()
    for name in ("one", "other"):
        make_signing_key(tmp_path / name)
        assert (tmp_path / name).stat().st_mode & 0o777 == 0o600
        keys.add(read_signing_key(tmp_path / name, warnings.append))
    assert len(keys) == 2
    assert warnings == []


def test_a_key_that_is_there_is_not_replaced(tmp_path: Path) -> None:
    file = tmp_path / "key"
    file.write_bytes(KEY)
    with pytest.raises(InputError, match=r"key: File exists; name a new file"):
        make_signing_key(file)
    assert file.read_bytes() == KEY
