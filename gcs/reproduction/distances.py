"""Tables 3 and 6: where each UAV starts, where it goes, and the distance travelled, which the paper's scan lost."""

from dataclasses import dataclass

from gcs.reproduction.reproduced import Reproduced


@dataclass(frozen=True)
class Distance:
    """One UAV's column of the table; kilometres.

    Attributes:
        sysid, name: of the UAV.
        origin_km, target_km: x, y, z.
        straight_km: between them; nothing is shorter.
        planned_km: by the hybrid's plan, corners rounded.
        flown_km: until arrival, in that plan's flight; None when it was not flown.
        skein_planned_km: by the plan of Skein's own method.
        hybrid_f_km, skein_f_km: the two plans' fitness.
    """

    sysid: int
    name: str
    origin_km: tuple[float, float, float]
    target_km: tuple[float, float, float]
    straight_km: float
    planned_km: float
    flown_km: float | None
    skein_planned_km: float
    hybrid_f_km: float
    skein_f_km: float


def distances(reproduced: Reproduced) -> tuple[Distance, ...]:
    """The whole table, in the order of the scenario."""
    flown = {} if reproduced.flown is None else {one.sysid: one for one in reproduced.flown.metrics.vehicles}
    scenario = reproduced.scenario
    return tuple(
        Distance(
            sysid=uav.sysid,
            name=uav.name,
            origin_km=_km(scenario.origin_m(vehicle)),
            target_km=_km(scenario.target_m(vehicle)),
            straight_km=uav.straight_line_m / 1000.0,
            planned_km=uav.length_m / 1000.0,
            flown_km=flown[uav.sysid].flown_length_km if flown else None,
            skein_planned_km=own.length_m / 1000.0,
            hybrid_f_km=uav.terms.fitness,
            skein_f_km=own.terms.fitness,
        )
        for vehicle, uav, own in zip(scenario.vehicles, reproduced.hybrid.uavs, reproduced.skein.uavs, strict=True)
    )


def _km(point_m: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = point_m
    return float(x) / 1000.0, float(y) / 1000.0, float(z) / 1000.0
