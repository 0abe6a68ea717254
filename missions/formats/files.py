"""Text files whose failures name the file."""

import codecs
from pathlib import Path

from missions.errors import InputError


def read_text(path: Path) -> str:
    """The file's text, UTF-8, or UTF-16 with the mark that says so; raises InputError when it cannot be read."""
    try:
        content = path.read_bytes()
        wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        return content.decode("utf-16" if wide else "utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; check the path") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start}: not UTF-8 text; export it again") from error


def write_text(path: Path, text: str) -> None:
    """Write a file; raises InputError when that is not possible."""
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; choose a folder that can be written to") from error
