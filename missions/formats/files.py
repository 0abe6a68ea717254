"""Text files whose failures name the file."""

from pathlib import Path

from missions.errors import InputError


def read_text(path: Path) -> str:
    """The file's text; raises InputError when it cannot be read."""
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; check the path") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start}: not UTF-8 text; export the mission again") from error


def write_text(path: Path, text: str) -> None:
    """Write a file; raises InputError when that is not possible."""
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; choose a folder that can be written to") from error
