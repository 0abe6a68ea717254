"""What a vehicle remembers over restarts: named pieces of bytes in a folder of its own, each whole or not at all."""

import contextlib
import errno
import os
import sys
import zlib
from pathlib import Path

from missions.errors import InputError

_CHECKSUM_BYTES = 4


class Store:
    """A vehicle's memory.

    Args:
        folder: where the pieces are, made when the first is kept; None forgets all at the end of the process.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder
        self._pieces: dict[str, bytes] = {}

    def read(self, name: str) -> bytes | None:
        """A piece; None when there is none.

        Raises:
            InputError: it is damaged or cannot be read.
        """
        if self._folder is None:
            return self._pieces.get(name)
        path = self._folder / name
        try:
            data = path.read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from error
        checksum, piece = data[:_CHECKSUM_BYTES], data[_CHECKSUM_BYTES:]
        if checksum != zlib.crc32(piece).to_bytes(_CHECKSUM_BYTES, "big"):
            raise InputError(f"{path}: damaged; remove it")
        return piece

    def write(self, name: str, piece: bytes) -> None:
        """Keep a piece in place of the old one: after a crash or a loss of power at any moment it is the one or the
        other, whole, and once this has returned, the new one.

        Raises:
            InputError: it could not be written, and the old one is still there; or it is there and the disk does not
                promise that it stays.
        """
        if self._folder is None:
            self._pieces[name] = piece
            return
        path = self._folder / name
        new = path.with_name(name + ".new")
        try:
            _make(self._folder)
            with new.open("wb") as file:
                file.write(zlib.crc32(piece).to_bytes(_CHECKSUM_BYTES, "big") + piece)
                file.flush()
                os.fsync(file.fileno())
            new.replace(path)
        except OSError as error:
            with contextlib.suppress(OSError):
                new.unlink(missing_ok=True)
            raise InputError(f"{path}: {error.strerror}; old one kept") from error
        try:
            _sync(self._folder)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}; it may be lost when the power goes") from error


def _make(folder: Path) -> None:
    """Make a folder, and bring it to the disk."""
    if not folder.is_dir():
        _make(folder.parent)
        folder.mkdir(exist_ok=True)
        _sync(folder.parent)


if sys.platform != "win32":

    def _sync(folder: Path) -> None:
        """Bring the names in a folder to the disk; what a file system does not do for folders is not asked of it."""
        opened = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(opened)
        except OSError as error:
            if error.errno != errno.EINVAL:
                raise
        finally:
            os.close(opened)

else:

    def _sync(folder: Path) -> None:
        """Windows has no such thing for folders."""
