"""Orders to vehicles over MAVLink, each seen in the vehicle's heartbeats before it counts as obeyed."""

from collections.abc import Callable, Collection, Sequence

from gcs.console.helm import Order
from gcs.fleet import Fleet
from gcs.operations import bring_home, change_mode, is_armed
from gcs.transfers.for_all import for_all
from gcs.vehicle_link import VehicleLink
from sitl.modes import Mode

MODES = {Order.AUTO: Mode.AUTO, Order.LOITER: Mode.LOITER, Order.RTL: Mode.RTL}


class FleetPilots:
    """The vehicles of a fleet.

    Args:
        fleet: theirs.
        note: called with who has obeyed, and what.
        lost: says who need not be asked.
    """

    def __init__(
        self,
        fleet: Fleet,
        note: Callable[[int, str], None] = lambda sysid, what: None,
        lost: Callable[[], Collection[int]] = tuple,
    ) -> None:
        self._fleet = fleet
        self._note = note
        self._lost = lost

    async def order(self, order: Order, sysids: Sequence[int]) -> list[str]:
        """See `Pilots`: those that obeyed in one line, a line for each that did not."""

        async def obey(vehicle: VehicleLink) -> str:
            if order is Order.ABORT:
                done = await bring_home(vehicle)
            else:
                await change_mode(vehicle, MODES[order])
                done = str(order.value)
                if not is_armed(vehicle):
                    done += ", but disarmed, and stays where it is: `skein arm` arms it"
            self._note(vehicle.sysid, done)
            return done

        asked = [i for i in sysids if i in self._fleet.vehicles and i not in self._lost()]
        results = await for_all([self._fleet.vehicles[i] for i in asked], obey)
        lines = []
        for what in dict.fromkeys(result for result in results.values() if isinstance(result, str)):
            obeyed = [str(sysid) for sysid, result in results.items() if result == what]
            lines.append(f"{'vehicle' if len(obeyed) == 1 else 'vehicles'} {', '.join(obeyed)}: {what}")
        return lines + [str(result) for result in results.values() if not isinstance(result, str)]
