"""How uploads fare on links that lose messages of every kind: both ends joined, on simulated time."""

import math
import statistics
from dataclasses import dataclass

from gcs.bench.foreign_stations import practice_mission
from gcs.bench.lossy_link import LossyLink, seeded_fates
from gcs.transfers.compare import differences
from gcs.transfers.errors import TransferError
from gcs.transfers.plan_download import PlanDownload
from gcs.transfers.plan_upload import PlanUpload
from missions.plan_type import PlanType
from missions.scenario import load_scenario
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle


@dataclass(frozen=True)
class LossyTransfers:
    """Uploads of one mission over links that differ in their seeds.

    Attributes:
        loss: part of the messages that is lost, each way.
        uploads: how many.
        failed: how many ended with an error, or with something else on the vehicle.
        upload_median_s, upload_slowest_s: simulated time until the vehicle has it.
        median_s, slowest_s: until it has been read back and compared as well.
    """

    loss: float
    uploads: int
    failed: int
    upload_median_s: float
    upload_slowest_s: float
    median_s: float
    slowest_s: float


def measure_transfers(loss: float, uploads: int, n_items: int = 100, delay_s: float = 0.05) -> LossyTransfers:
    """Upload a mission of `n_items` and read it back, `uploads` times, over `delay_s` each way."""
    scenario = load_scenario("vee")
    config = vehicle_configs(scenario, SwarmOptions(seed=1, delay_s=0.0))[0]
    vehicle = Vehicle(config, TruthWriter(None))
    items = practice_mission(scenario, scenario.vehicles[0], n_items).items
    uploaded_s, verified_s = [], []
    for seed in range(uploads):
        vehicle.load(PlanType.MISSION, (vehicle.home,))
        link = LossyLink(vehicle, seeded_fates(seed, loss, delay_s))
        if isinstance(link.run(PlanUpload(PlanType.MISSION, items, *link.link())), TransferError):
            continue
        took_s = link.time_s
        held = link.run(PlanDownload(PlanType.MISSION, *link.link()))
        if isinstance(held, TransferError) or differences(PlanType.MISSION, items, held):
            continue
        uploaded_s.append(took_s)
        verified_s.append(link.time_s)
    failed = uploads - len(verified_s)
    if failed == uploads:
        return LossyTransfers(loss, uploads, failed, math.inf, math.inf, math.inf, math.inf)
    return LossyTransfers(
        loss,
        uploads,
        failed,
        statistics.median(uploaded_s),
        max(uploaded_s),
        statistics.median(verified_s),
        max(verified_s),
    )
