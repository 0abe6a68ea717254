"""What is left of uploads when an end is killed: a real endpoint's process and a real station's, at each step.

A step is a message of the transfer, sent or received, or, where the endpoint keeps the plan, a line of `sitl.store`.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import closing, contextmanager, nullcontext
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias
from unittest.mock import patch

from gcs.bench.foreign_stations import practice_mission
from gcs.bench.mortal_endpoint import run_until_line
from gcs.bench.mortal_station import MortalStation, socket_for_a_station, upload_and_die
from gcs.transfers.compare import differences
from gcs.transfers.errors import TransferError
from gcs.transfers.plan_download import PlanDownload
from gcs.transfers.plan_transfer import NOUNS
from gcs.transfers.plan_upload import PlanUpload
from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, rally_items
from missions.mission import MissionItem
from missions.plan_type import HELD, PlanType
from missions.scenario import load_scenario
from sitl import child
from sitl.child import EndpointProcess
from sitl.swarm import Swarm, SwarmOptions

Items: TypeAlias = tuple[MissionItem, ...]
Steps: TypeAlias = Iterable[int]
EVERY_STEP: Steps = range(1, 10_000)


@dataclass
class Kills:
    """What there was after a kill at each of some steps.

    Attributes:
        kills: how many there were.
        old, new: after how many the vehicle held the whole old plan, and the whole new one, as read back.
        neither: after how many something else, another of its plans had changed, or the next upload failed.
        busy: how many stations at another address were told, right after a station's death, to try later.
    """

    kills: int = 0
    old: int = 0
    new: int = 0
    neither: int = 0
    busy: int = 0


def measure_kills(n_items: int) -> dict[str, Kills]:
    """Every kill of every kind with plans of so many items; by who is killed, and over which type of plan."""
    with TemporaryDirectory() as memory, KilledTransfers(Path(memory), n_items) as transfers:
        kills = {}
        for plan in HELD:
            name = NOUNS[plan]
            kills[f"endpoint, {name}"] = transfers.kill_endpoint(plan)
            kills[f"endpoint keeping the plan, {name}"] = transfers.kill_endpoint_writing(plan)
            kills[f"station, {name}"] = transfers.kill_station(plan)
            kills[f"station, given up after a while, {name}"] = transfers.kill_station_and_wait(plan, [1, n_items])
        return kills


def two_plans(plan: PlanType, n_items: int) -> tuple[Items, Items]:
    """Two plans of a type that differ in each item but home, near the lead of the shipped V."""
    scenario = load_scenario("vee")
    mission = practice_mission(scenario, scenario.vehicles[0], n_items).items
    if plan == PlanType.MISSION:
        return mission, tuple(replace(item, alt_m=item.alt_m + 500.0) for item in mission)
    home = mission[0]
    first, second = (
        [(home.lat_e7 + 20_000 * i, home.lon_e7 + 1_000 * i * i) for i in of]
        for of in (range(n_items), range(-n_items, 0))
    )
    return (_fence(first), _fence(second)) if plan == PlanType.FENCE else (_rally(first), _rally(second))


class KilledTransfers:
    """One vehicle in a process of its own, as `skein sim` starts it, with all plans in its folder. A context manager.

    Args:
        memory: its state folder.
        n_items: of each plan; 4 at least.
    """

    def __init__(self, memory: Path, n_items: int) -> None:
        self.swarm = Swarm(load_scenario("vee"), SwarmOptions(seed=1, delay_s=0.2, memory=memory, count=1))
        (self.sysid,) = self.swarm.endpoints
        self._plans = {plan: two_plans(plan, n_items) for plan in HELD}
        self._held = {plan: items for plan, (items, _) in self._plans.items()}
        with self._station() as station:
            for plan, items in self._held.items():
                station.run(partial(PlanUpload, plan, items))

    def __enter__(self) -> "KilledTransfers":
        return self

    def __exit__(self, *_: object) -> None:
        self.swarm.end()

    def kill_endpoint(self, plan: PlanType, steps: Steps = EVERY_STEP) -> Kills:
        """Kill the endpoint after each of so many messages of an upload, and start it again."""
        kills = Kills()
        for step in steps:
            with self._station() as station:
                outcome = station.run(self._upload(plan), step)
            self.restart()
            self._look(plan, kills)
            if outcome is not None:
                break
        return kills

    def kill_endpoint_writing(self, plan: PlanType, steps: Steps = EVERY_STEP) -> Kills:
        """Kill the endpoint before each of so many lines with which it keeps the new plan, and start it again."""
        kills = Kills()
        for step in steps:
            with patch.object(child, "run_process", partial(run_until_line, step)):
                self.restart()
            with self._station() as station:
                outcome = station.run(self._upload(plan), endpoint=self._process.reports.fileno())
            self.restart()
            self._look(plan, kills)
            if outcome is not None:
                break
        return kills

    def kill_station(self, plan: PlanType, steps: Steps = EVERY_STEP) -> Kills:
        """Kill a station after each of so many messages of its upload.

        At once another station tries to upload, and then one at the same address, the same one restarted, downloads and
        uploads.
        """
        kills = Kills()
        for step in steps:
            with closing(socket_for_a_station()) as end:
                died = upload_and_die(self.udp_port, self.sysid, end, plan, self._other(plan), step)
                with self._station() as elsewhere:
                    kills.busy += _is_busy(elsewhere.run(self._upload(plan)))
                again = MortalStation(self.udp_port, self.sysid, end)
                self._look(plan, kills, again)
                self._go_on(plan, kills, again)
            if not died:
                break
        return kills

    def kill_station_and_wait(self, plan: PlanType, steps: Steps) -> Kills:
        """Kill a station after each of so many messages; another waits to download until the first is given up."""
        kills = Kills()
        for step in steps:
            with closing(socket_for_a_station()) as end, self._station() as elsewhere:
                upload_and_die(self.udp_port, self.sysid, end, plan, self._other(plan), step)
                kills.busy += _is_busy(elsewhere.run(self._upload(plan)))
                self._look(plan, kills, elsewhere)
                self._go_on(plan, kills, elsewhere)
        return kills

    def restart(self) -> None:
        """Kill the endpoint, if it is not dead, and start it again."""
        self._process.kill()
        self.swarm.restart(self.sysid)

    @property
    def _process(self) -> EndpointProcess:
        return self.swarm.endpoints[self.sysid].process

    @property
    def udp_port(self) -> int:
        ready = self.swarm.endpoints[self.sysid].ready
        assert ready is not None
        return ready.udp_port

    @contextmanager
    def _station(self) -> Iterator[MortalStation]:
        with closing(MortalStation(self.udp_port, self.sysid)) as station:
            yield station

    def _other(self, plan: PlanType) -> Items:
        """The plan that is not held."""
        first, second = self._plans[plan]
        return second if self._held[plan] == first else first

    def _upload(self, plan: PlanType) -> Callable[..., PlanUpload]:
        return partial(PlanUpload, plan, self._other(plan))

    def _look(self, plan: PlanType, kills: Kills, station: MortalStation | None = None) -> None:
        """See what the vehicle holds of all types, and note it."""
        with nullcontext(station) if station else self._station() as reader:
            found = {one: reader.run(partial(PlanDownload, one)) for one in HELD}
        others = all(_are_equal(one, items, found[one]) for one, items in self._held.items() if one != plan)
        kills.kills += 1
        if others and _are_equal(plan, self._held[plan], found[plan]):
            kills.old += 1
        elif others and _are_equal(plan, self._other(plan), found[plan]):
            kills.new += 1
            self._held[plan] = self._other(plan)
        else:
            kills.neither += 1

    def _go_on(self, plan: PlanType, kills: Kills, station: MortalStation) -> None:
        """Upload the plan that is not held, and see that it is then."""
        station.run(self._upload(plan))
        if _are_equal(plan, self._other(plan), station.run(partial(PlanDownload, plan))):
            self._held[plan] = self._other(plan)
        else:
            kills.neither += 1


def _are_equal(plan: PlanType, items: Items, held: Any) -> bool:
    return not isinstance(held, TransferError) and not differences(plan, items, held)


def _is_busy(outcome: Any) -> bool:
    return isinstance(outcome, TransferError) and "MAV_MISSION_DENIED" in str(outcome)


def _fence(places: list[tuple[int, int]]) -> Items:
    """A circle and a polygon."""
    return fence_items(Fence((FenceCircle(False, places[0], 50.0), FencePolygon(True, tuple(places[1:])))))


def _rally(places: list[tuple[int, int]]) -> Items:
    return rally_items([(lat_e7, lon_e7, 80.0) for lat_e7, lon_e7 in places])
