"""The versions that a flight may depend on."""

import platform
from importlib.metadata import version

DISTRIBUTION = "skein-gcs"
PACKAGES = (DISTRIBUTION, "numpy", "scipy", "numba", "pymavlink", "eclipse-zenoh")


def versions() -> dict[str, str]:
    """Versions by package, Python's last."""
    return {name: version(name) for name in PACKAGES} | {"Python": platform.python_version()}
