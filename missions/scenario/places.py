"""The tables of where things are: origin, area, terrain, radars, obstacles. Lengths in metres."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from missions.scenario.keys import Keys, Number, Positive, Range

Latitude = Annotated[Number, Field(ge=-85, le=85)]
Longitude = Annotated[Number, Field(ge=-180, le=180)]


class OriginModel(Keys):
    """Where on the globe the local frame lies."""

    lat_deg: Latitude
    lon_deg: Longitude
    alt_m: Number = 0.0
    """AMSL altitude of z = 0."""


class AreaModel(Keys):
    """The box of equation (1), local frame."""

    x_m: Range
    y_m: Range
    z_m: Range

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        for key in ("x_m", "y_m", "z_m"):
            low, high = getattr(self, key)
            if not low < high:
                raise ValueError(f"the first number of {key} must be smaller than the second, got [{low:g}, {high:g}]")
        return self


class PeakModel(Keys):
    """One mountain of equation (2)."""

    height_m: Number
    x_m: Number
    y_m: Number
    decline_x_m: Positive
    decline_y_m: Positive


class WaveModel(Keys):
    """The datum wave Z1 of equation (2), whose sines take kilometres, times an amplitude."""

    amplitude_m: Number
    a: Number = 0.0
    b: Number = 0.0
    c: Number = 0.0
    d: Number = 0.0
    e: Number = 0.0
    f: Number = 0.0
    g: Number = 0.0


class TerrainModel(Keys):
    """The ground of equation (2), flat at `base_m` without peaks; or real ground from an elevation file."""

    base_m: Number = 0.0
    wave: WaveModel | None = None
    peaks: tuple[PeakModel, ...] = ()
    raster: Annotated[str, Field(min_length=1)] | None = None
    """A .npz, .tif, .tiff or .hgt file, relative to the scenario's own, or "matplotlib:..." of its sample data. Read
    as metres AMSL."""
    spacing_m: Annotated[Number, Field(ge=1)] | None = None
    """Between the posts that the raster is resampled to; about its own unless given."""

    @model_validator(mode="after")
    def _one_ground(self) -> Self:
        if self.raster is not None and (self.base_m != 0.0 or self.wave is not None or self.peaks):
            raise ValueError("raster takes the place of base_m, wave and peaks; leave them out")
        if self.raster is None and self.spacing_m is not None:
            raise ValueError("spacing_m is between the posts of a raster; name one or leave it out")
        return self


class RadarModel(Keys):
    """A radar's sphere, equations (7)-(8)."""

    x_m: Number
    y_m: Number
    z_m: Number
    radius_m: Positive
    intensity_m: Positive | None = None
    """delta of (7); the radius unless given."""


class ObstacleModel(Keys):
    """A tall building: a vertical cylinder that stands on the ground."""

    x_m: Number
    y_m: Number
    radius_m: Positive
    height_m: Positive
