"""Elevation files: where a scenario's real ground comes from."""

from missions.elevation.archive import write_local_raster
from missions.elevation.read import read_raster

__all__ = ["read_raster", "write_local_raster"]
