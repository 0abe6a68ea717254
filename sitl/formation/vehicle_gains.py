"""The gains that one vehicle of a scenario flies with."""

from missions.scenario.network import FormationModel
from sitl.formation.law import Gains


def vehicle_gains(formation: FormationModel, sysid: int) -> Gains:
    """The formation's gains; a vehicle with h_p = 0 has no pin."""
    return Gains(formation.k1, formation.k2, formation.k3, formation.k0 if formation.is_pinned(sysid) else 0.0)
