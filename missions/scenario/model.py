"""The keys of a scenario file. Lengths in metres, speeds in m/s, angles in degrees, times in seconds."""

import math
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, Self, TypedDict

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError, ValidationInfo, model_validator

from missions.airframe import Airframe
from missions.elevation import read_raster
from missions.environment import Area, Environment, Obstacle, Radar, Terrain, ground_height_m
from missions.environment.raster import Raster
from missions.environment.terrain import NO_WAVE
from missions.errors import InputError
from missions.frame import LocalFrame
from missions.scenario.shape import Pattern, pattern_slots, width_of

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Number, Field(gt=0)]
NotNegative = Annotated[Number, Field(ge=0)]
Fraction = Annotated[Number, Field(gt=0, le=1)]
Count = Annotated[int, Field(strict=True, ge=1)]
Point = tuple[Number, Number, Number]
Vector = tuple[Number, Number]
Range = tuple[Number, Number]


class Keys(BaseModel):
    """A table of the file: immutable, unknown keys refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class OriginModel(Keys):
    """Where on the globe the local frame lies."""

    lat_deg: Annotated[Number, Field(ge=-85, le=85)]
    lon_deg: Annotated[Number, Field(ge=-180, le=180)]
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


class SlotModel(Keys):
    """A place in a formation that follows `route`."""

    behind_m: Number
    left_m: Number


class VehicleModel(Keys):
    """One vehicle: with `origin` and `target`, or with a `slot` on the route."""

    name: Annotated[str, Field(min_length=1, pattern=r"^[\w-]+$")]
    sysid: Annotated[int, Field(strict=True, ge=1, le=250)]
    origin: Point | None = None
    target: Point | None = None
    slot: SlotModel | None = None

    @model_validator(mode="after")
    def _one_way_to_go(self) -> Self:
        if self.slot is None and (self.origin is None or self.target is None):
            raise ValueError("needs origin and target, or a slot")
        if self.slot is not None and (self.origin is not None or self.target is not None):
            raise ValueError("has a slot, so origin and target follow from the route; leave them out")
        return self


class RouteModel(Keys):
    """The polyline that a slot formation flies, or its ends, between which one is searched; and the ground speed."""

    points: Annotated[tuple[Point, ...], Field(min_length=2)]
    """The straight line where only the ends are given: slots start and end beside it."""
    origin: Point | None = None
    target: Point | None = None
    ground_speed_m_s: Positive

    @model_validator(mode="before")
    @classmethod
    def _straight_between_ends(cls, data: Any) -> Any:
        if isinstance(data, dict) and data.get("origin") is not None and data.get("target") is not None:
            ends, points = [data["origin"], data["target"]], data.get("points")
            if points is not None and list(points) != ends:
                raise ValueError("takes either points, or origin and target between which a route is searched")
            return {**data, "points": ends}
        return data

    @property
    def is_searched(self) -> bool:
        """Whether only its ends are given."""
        return self.origin is not None and self.target is not None


class ShapeModel(Keys):
    """A formation's pattern, from which vehicles' slots follow."""

    pattern: Pattern
    count: Annotated[int, Field(strict=True, ge=1, le=250)] | None = None
    """Vehicles; as many as are listed unless given."""
    spacing_m: Positive | None = None
    """Between neighbours; or"""
    width_m: Positive | None = None
    """from the leftmost to the rightmost slot."""

    @model_validator(mode="after")
    def _measured(self) -> Self:
        measures = [key for key in ("spacing_m", "width_m") if getattr(self, key) is not None]
        if self.pattern == "custom":
            if measures:
                raise ValueError(f"a custom shape's slots stand at the vehicles; leave {measures[0]} out")
        elif len(measures) != 1:
            raise ValueError("give either spacing_m (between neighbours) or width_m (of the whole)")
        elif self.pattern == "column" and self.width_m is not None:
            raise ValueError("a column has no width; give spacing_m")
        return self

    def slots(self, count: int) -> list[SlotModel]:
        """Of `count` vehicles, the leader's first; none for a custom shape."""
        if self.pattern == "custom":
            return []
        places = pattern_slots(self.pattern, count)
        spacing_m = self.spacing_m or (self.width_m or 0.0) / (width_of(places) or 1.0)
        return [SlotModel(behind_m=spacing_m * behind, left_m=spacing_m * left) for behind, left in places]


class AirframeModel(Keys):
    """The aircraft type. Sources of the shipped values stand in the shipped files."""

    name: str
    mass_kg: Positive
    wing_area_m2: Positive
    drag_coefficient_zero_lift: Positive
    induced_drag_factor: Positive
    lift_coefficient_max: Positive
    shaft_power_w: Positive
    propeller_efficiency: Fraction
    static_thrust_n: Positive
    airspeed_min_m_s: Positive
    airspeed_max_m_s: Positive
    airspeed_cruise_m_s: Positive
    climb_rate_min_m_s: Annotated[Number, Field(lt=0)]
    climb_rate_max_m_s: Positive
    load_factor_max: Annotated[Number, Field(gt=1)]
    bank_max_deg: Annotated[Number, Field(gt=0, lt=80)]
    thrust_lag_s: Positive
    bank_lag_s: Positive
    lift_lag_s: Positive

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if not self.airspeed_min_m_s < self.airspeed_cruise_m_s < self.airspeed_max_m_s:
            raise ValueError("airspeeds must rise from airspeed_min_m_s over airspeed_cruise_m_s to airspeed_max_m_s")
        return self

    def airframe(self) -> Airframe:
        """The values for the compiled core."""
        values = self.model_dump(exclude={"name", "bank_max_deg"})
        return Airframe(bank_max=math.radians(self.bank_max_deg), **values)


class FormationModel(Keys):
    """Who hears whom, with what delay, and the gains of the law (15)."""

    graph: Literal["ring", "line", "star", "complete"] = "ring"
    delay_s: Annotated[NotNegative, Field(le=60)] = 0.2
    k1: NotNegative = 0.2
    k2: NotNegative = 0.8
    k3: NotNegative = 0.4
    k0: NotNegative = 0.01


class WindModel(Keys):
    """What blows, and what the planner was told. East and north components."""

    steady_m_s: Vector = (0.0, 0.0)
    forecast_m_s: Vector = (0.0, 0.0)
    gusts: Literal["none", "light", "moderate"] = "light"


class LimitsModel(Keys):
    """The constraints (12), safe distances and penalties (5), (9)."""

    altitude_max_m: Positive
    leg_min_m: Positive = 300.0
    leg_max_m: Positive = 8000.0
    turn_max_deg: Annotated[Number, Field(gt=0, lt=180)] = 60.0
    climb_max_deg: Annotated[Number, Field(gt=0, lt=60)] = 8.0
    separation_m: Positive
    """d_safe between UAVs."""
    obstacle_margin_m: NotNegative = 100.0
    """d_safe beyond an obstacle's wall."""
    clearance_m: NotNegative
    """Above ground in flight; after launch it builds up evenly over `climb_out_m`."""
    climb_out_m: Positive = 2000.0
    collision_penalty_km: Positive = 100.0
    """P_c of (9)."""
    terrain_penalty_km: Positive = 100.0
    """epsilon of (5)."""
    terrain_constant_km2: Positive = 1.0
    """K of (5)."""


class SearchModel(Keys):
    """How paths are searched for."""

    method: Literal["skein", "pso", "qpso", "hybrid", "published"] = "skein"
    waypoints: Count = 12
    """Interior waypoints of each path."""
    population: Annotated[int, Field(strict=True, ge=4)] = 150
    iterations: Count = 200
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
    description: str = ""
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**63)] = 1
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
    wind: WindModel = WindModel()
    limits: LimitsModel
    search: SearchModel = SearchModel()
    _raster: Raster | None = PrivateAttr(None)

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
