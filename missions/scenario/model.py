"""The keys of a scenario file. Lengths in metres, speeds in m/s, angles in degrees, times in seconds."""

import math
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, Self, TypedDict

from pydantic import Field, PrivateAttr, ValidationError, ValidationInfo, model_validator

from missions.elevation import read_raster
from missions.environment import Area, Environment, Obstacle, Radar, Terrain, ground_height_m
from missions.environment.raster import Raster
from missions.environment.terrain import NO_WAVE
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.scenario.aircraft import AirframeModel
from missions.scenario.degrees import in_metres
from missions.scenario.keys import Count, Keys, NotNegative, Number, Point, Positive, Vector
from missions.scenario.network import ChannelModel, FailureModel, FormationModel, LinkModel
from missions.scenario.places import (
    AreaModel,
    ObstacleModel,
    OriginModel,
    RadarModel,
    TerrainModel,
)
from missions.scenario.vehicles import RouteModel, ShapeModel, VehicleModel


class WindModel(Keys):
    """What blows, and what the planner was told. East and north components."""

    steady_m_s: Vector = (0.0, 0.0)
    """What blows all the time."""
    forecast_m_s: Vector = (0.0, 0.0)
    """What the planner reckons with."""
    gusts: Literal["none", "light", "moderate"] = "light"
    """Dryden gusts on top."""


class LimitsModel(Keys):
    """The constraints (12), safe distances and penalties (5), (9)."""

    altitude_max_m: Positive
    """Of paths, above z = 0."""
    leg_min_m: Positive = 300.0
    """Between waypoints."""
    leg_max_m: Positive = 8000.0
    """Between waypoints."""
    turn_max_deg: Annotated[Number, Field(gt=0, lt=180)] = 60.0
    """At a waypoint."""
    climb_max_deg: Annotated[Number, Field(gt=0, lt=60)] = 8.0
    """Of a leg, up and down."""
    separation_m: Positive
    """d_safe between UAVs."""
    obstacle_margin_m: NotNegative = 100.0
    """d_safe beyond an obstacle's wall."""
    clearance_m: NotNegative
    """Above ground in flight; after launch it builds up evenly over `climb_out_m`."""
    climb_out_m: Positive = 2000.0
    """Of path, from the launch."""
    collision_penalty_km: Positive = 100.0
    """P_c of (9)."""
    terrain_penalty_km: Positive = 100.0
    """epsilon of (5)."""
    terrain_constant_km2: Positive = 1.0
    """K of (5)."""


class SearchModel(Keys):
    """How paths are searched for."""

    method: Literal["skein", "pso", "qpso", "hybrid", "published"] = "skein"
    """`pso`, `qpso` and `hybrid` are the paper's, `published` its hybrid as printed."""
    waypoints: Annotated[int, Field(strict=True, ge=1, le=60)] = 12
    """Interior waypoints of each path."""
    population: Annotated[int, Field(strict=True, ge=4)] = 150
    """Of the paper's methods."""
    iterations: Count = 200
    """Of the paper's methods."""
    reading: Literal["graded", "published"] = "graded"
    """Of the penalties (MODEL, section 3)."""


class Files(TypedDict):
    """Where the files are that a scenario names: the validation context of `Scenario`.

    `raster` is read in place of the one that is named, when it is not None.
    """

    folder: Path
    raster: Path | None


class Scenario(Keys):
    """A whole scenario file."""

    name: Annotated[str, Field(min_length=1, pattern=r"^[\w-]+$")]
    """In all that is written of it."""
    description: str = ""
    """For people."""
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**63)] = 1
    """Of search, gusts and channels."""
    origin: OriginModel
    area: AreaModel
    terrain: TerrainModel = TerrainModel()
    radars: tuple[RadarModel, ...] = ()
    obstacles: tuple[ObstacleModel, ...] = ()
    shape: ShapeModel | None = None
    vehicles: Annotated[tuple[VehicleModel, ...], Field(min_length=1)]
    """Listed, or made for a shape's slots."""
    route: RouteModel | None = None
    airframe: AirframeModel
    formation: FormationModel = FormationModel()
    channel: ChannelModel = ChannelModel()
    links: tuple[LinkModel, ...] = ()
    failures: tuple[FailureModel, ...] = ()
    wind: WindModel = WindModel()
    limits: LimitsModel
    search: SearchModel = SearchModel()
    _raster: Raster | None = PrivateAttr(None)

    @model_validator(mode="before")
    @classmethod
    def _take_degrees(cls, data: Any) -> Any:
        """Places may be given by latitude and longitude."""
        return in_metres(data) if isinstance(data, dict) else data

    @model_validator(mode="before")
    @classmethod
    def _take_slots(cls, data: Any) -> Any:
        """Vehicles that are listed without a slot take the shape's in order; without a list, they are made for it."""
        if not isinstance(data, dict) or data.get("shape") is None:
            return data
        try:
            shape = ShapeModel.model_validate(data["shape"])
        except ValidationError:
            return data  # told of as the shape's own
        listed = data.get("vehicles")
        count = shape.count or (len(listed) if isinstance(listed, Sequence) else 0)
        if listed is None:
            slots = shape.slots(count)
            vehicles: list[Any] = [
                {"name": f"wing{k}" if k else "lead", "sysid": k + 1, "slot": slot} for k, slot in enumerate(slots)
            ]
            return {**data, "vehicles": vehicles} if vehicles else data
        if isinstance(listed, Sequence) and count != len(listed):
            raise ValueError(f"shape.count: {count}, but {len(listed)} vehicles are listed; leave one of the two out")
        slots = shape.slots(count)
        if not slots:
            return data
        taken = [
            {"slot": slot, **vehicle} if isinstance(vehicle, dict) and "origin" not in vehicle else vehicle
            for vehicle, slot in zip(listed, slots, strict=True)
        ]
        return {**data, "vehicles": taken}

    @model_validator(mode="after")
    def _read_raster(self, info: ValidationInfo) -> Self:
        name, spacing_m = self.terrain.raster, self.terrain.spacing_m
        if name is not None:
            files: Files = info.context or Files(folder=Path(), raster=None)
            try:
                self._raster = read_raster(
                    str(files["raster"] or name),
                    files["folder"],
                    self.frame,
                    Area(*self.area.x_m, *self.area.y_m, *self.area.z_m),
                    spacing_m,
                )
            except InputError as error:
                raise ValueError(f"terrain.raster: {error}") from None
        return self

    @property
    def raster(self) -> Raster | None:
        """The real ground, where there is one: heights above z = 0, local frame."""
        return self._raster

    @cached_property
    def frame(self) -> LocalFrame:
        """The local frame."""
        return LocalFrame(self.origin.lat_deg, self.origin.lon_deg, self.origin.alt_m)

    @cached_property
    def environment(self) -> Environment:
        """The mission area as geometry."""
        wave = self.terrain.wave
        terrain = Terrain(
            base_m=self.terrain.base_m,
            wave=(wave.amplitude_m, wave.a, wave.b, wave.c, wave.d, wave.e, wave.f, wave.g) if wave else NO_WAVE,
            peaks=[(p.height_m, p.x_m, p.y_m, p.decline_x_m, p.decline_y_m) for p in self.terrain.peaks],
        )
        if self.raster is not None:
            terrain = terrain._replace(**self.raster._asdict())
        return Environment(
            area=Area(*self.area.x_m, *self.area.y_m, *self.area.z_m),
            terrain=terrain,
            radars=tuple(Radar(r.x_m, r.y_m, r.z_m, r.radius_m, r.intensity_m or r.radius_m) for r in self.radars),
            obstacles=tuple(
                Obstacle(o.x_m, o.y_m, o.radius_m, ground_height_m(o.x_m, o.y_m, terrain) + o.height_m)
                for o in self.obstacles
            ),
        )

    def origin_m(self, vehicle: VehicleModel) -> Point:
        """Where a vehicle starts: its origin or its slot's, lifted to the ground where that is higher."""
        x, y, z = vehicle.origin or self._slot_point(vehicle, at_end=False)
        return x, y, max(z, ground_height_m(x, y, self.environment.terrain))

    def target_m(self, vehicle: VehicleModel) -> Point:
        """Where a vehicle goes: its target or its slot's at the route's end."""
        return vehicle.target or self._slot_point(vehicle, at_end=True)

    def _slot_point(self, vehicle: VehicleModel, *, at_end: bool) -> Point:
        """The slot's place beside the first or the last point of the route."""
        assert vehicle.slot is not None
        assert self.route is not None
        start, end = self.route.points[-2:] if at_end else self.route.points[:2]
        x, y, z = end if at_end else start
        heading = math.atan2(end[1] - start[1], end[0] - start[0])
        ahead, left = -vehicle.slot.behind_m, vehicle.slot.left_m
        return (
            x + ahead * math.cos(heading) - left * math.sin(heading),
            y + ahead * math.sin(heading) + left * math.cos(heading),
            z,
        )
