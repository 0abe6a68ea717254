"""The tables of who flies where: vehicles, slots, the route and the shape of a formation."""

from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from missions.scenario.keys import Keys, Number, Point, Positive
from missions.scenario.shape import Pattern, pattern_slots, width_of


class SlotModel(Keys):
    """A place in a formation that follows `route`."""

    behind_m: Number
    """The point that follows the route."""
    left_m: Number
    """Of that point; to the right, negative."""


class VehicleModel(Keys):
    """One vehicle: with `origin` and `target`, or with a `slot` on the route."""

    name: Annotated[str, Field(min_length=1, pattern=r"^[\w-]+$")]
    """In all that is written of it."""
    sysid: Annotated[int, Field(strict=True, ge=1, le=250)]
    """MAVLink's, one for each vehicle."""
    origin: Point | None = None
    """Where it starts; lifted to the ground where that is higher."""
    target: Point | None = None
    """Where it goes."""
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
    """With `target`, in place of `points`: a route is searched between them."""
    target: Point | None = None
    """See `origin`."""
    ground_speed_m_s: Positive
    """Of the point that the slots follow."""

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
    """With `custom`, slots stand at the vehicles."""
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
