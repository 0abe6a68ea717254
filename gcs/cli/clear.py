"""`skein clear`: vehicles forget their plans."""

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption
from gcs.cli.station import (
    ConnectOption,
    KeyOption,
    StationOptions,
    VehicleOption,
    WaitOption,
    for_vehicles,
)

if TYPE_CHECKING:
    from gcs.vehicle_link import VehicleLink


class Plans(StrEnum):
    """What can be cleared."""

    mission = "mission"
    fence = "fence"
    rally = "rally"
    all = "all"


PlansArgument = Annotated[Plans, typer.Argument(metavar="mission|fence|rally|all", help="What to clear.")]


def clear(
    plans: PlansArgument,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Clear missions, fences or rally points.

    Of all vehicles at once; and see that nothing is left.

    Example: skein clear fence --vehicle 3
    """
    with exit_codes():
        from gcs.transfers.plans import clear as clear_plan
        from missions.plan_type import HELD, PlanType

        chosen = HELD if plans == Plans.all else (PlanType[plans.name.upper()],)

        async def clear_chosen(one: "VehicleLink") -> list[str]:
            for plan_type in chosen:
                await clear_plan(one, plan_type)
            return [plan_type.name.lower() for plan_type in chosen]

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        for_vehicles(options, "Cleared", clear_chosen, words=", ".join)
