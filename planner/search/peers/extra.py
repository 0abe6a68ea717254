"""Libraries that only comparisons need."""

import importlib
from typing import Any

from missions.errors import InputError

LARGEST = 1e300
"""Stands for an infinite cost where a library computes with differences of costs."""


def extra(library: str, method: str) -> Any:
    """The library's module.

    Raises:
        InputError: it is not installed.
    """
    try:
        return importlib.import_module(library)
    except ImportError:
        raise InputError(
            f"method {method}: needs the library {library}, which is not installed; pip install 'skein-gcs[bench]'"
        ) from None
