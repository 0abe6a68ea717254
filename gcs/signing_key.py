"""Signing keys in files."""

import base64
import binascii
import hashlib
import os
import secrets
import stat
from collections.abc import Callable
from pathlib import Path

from missions.errors import InputError
from sitl.services.signing import KEY_BYTES, NO_KEY


def read_signing_key(path: Path, warn: Callable[[str], None]) -> bytes:
    """The key in a file: 32 raw bytes, 64 hexadecimal digits, base64 of 32 bytes, or else a passphrase.

    A passphrase's key is its SHA-256, as in Mission Planner and MAVProxy; white space around it does not count.

    Args:
        path: the file.
        warn: called when others can read the file.

    Raises:
        InputError: it cannot be read, or there is nothing in it.
    """
    try:
        data = path.read_bytes()
        mode = path.stat().st_mode
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; name a file with a signing key") from error
    if mode & stat.S_IROTH:
        warn(f"{path}: every user can read this key; chmod go= {path}")
    key = _key(data)
    if key == NO_KEY:
        raise InputError(f"{path}: no signing key in it; write a passphrase or {KEY_BYTES} bytes into it")
    return key


def make_signing_key(path: Path) -> None:
    """Write a random key, as hexadecimal digits, to a new file that only its owner can read.

    Raises:
        InputError: there is such a file, which may hold a key in use, or it cannot be written.
    """
    try:
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, stat.S_IRUSR | stat.S_IWUSR)
        with os.fdopen(descriptor, "w", encoding="ascii") as file:
            file.write(secrets.token_hex(KEY_BYTES) + "\n")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; name a new file for the key") from error


def _key(data: bytes) -> bytes:
    text = data.strip()
    if len(data) == KEY_BYTES and not (text.isascii() and text.decode().isprintable()):
        return data
    if not text:
        return NO_KEY
    for decode in (binascii.unhexlify, lambda text: base64.b64decode(text, validate=True)):
        try:
            key = bytes(decode(text))
        except ValueError:
            continue
        if len(key) == KEY_BYTES:
            return key
    return hashlib.sha256(text).digest()
