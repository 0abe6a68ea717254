"""Whoever is killed, and whenever: the vehicle holds the whole old plan or the whole new one, and transfers go on.

Some steps of each kind; `make soak` takes them all.
"""

import sys
from collections.abc import Iterator

import pytest

from gcs.bench.killed_transfers import KilledTransfers, Kills
from missions.plan_type import HELD, PlanType

if sys.platform == "win32":
    pytest.skip("nobody can be killed in the middle of a line there", allow_module_level=True)

ITEMS = 4
LAST_ITEM_SENT, OVER = 9, 1000
"""Messages of an upload: MISSION_COUNT, four requests and items; and more than there are, on however slow a machine."""


@pytest.fixture(scope="module")
def transfers(tmp_path_factory: pytest.TempPathFactory) -> Iterator[KilledTransfers]:
    with KilledTransfers(tmp_path_factory.mktemp("state") / "swarm", ITEMS) as transfers:
        yield transfers


@pytest.mark.parametrize(
    ("plan", "before"), [(PlanType.MISSION, (1, 4, 8)), (PlanType.FENCE, (7,)), (PlanType.RALLY, (2,))]
)
def test_an_endpoint_killed_at_any_message_has_a_whole_plan_when_it_is_back(
    transfers: KilledTransfers, plan: PlanType, before: tuple[int, ...]
) -> None:
    assert transfers.kill_endpoint(plan, before) == Kills(len(before), old=len(before))
    kills = transfers.kill_endpoint(plan, [LAST_ITEM_SENT])
    assert (kills.neither, kills.old + kills.new) == (0, 1)  # it may have been the quicker
    assert transfers.kill_endpoint(plan, [OVER]) == Kills(1, new=1)


def test_an_endpoint_killed_while_it_keeps_a_plan_has_a_whole_one_when_it_is_back(transfers: KilledTransfers) -> None:
    kills = transfers.kill_endpoint_writing(PlanType.MISSION, range(1, 100, 4))
    assert kills.neither == 0
    assert kills.old >= 2
    assert kills.new >= 2
    assert 5 <= kills.kills < 25, "the last one was not killed any more"


@pytest.mark.parametrize("plan", HELD)
def test_when_a_station_is_killed_others_find_a_whole_plan_and_it_goes_on_at_once(
    transfers: KilledTransfers, plan: PlanType
) -> None:
    assert transfers.kill_station(plan, [1 + 3 * plan]) == Kills(1, old=1, busy=1)
    kills = transfers.kill_station(plan, [LAST_ITEM_SENT])
    assert (kills.neither, kills.old + kills.new) == (0, 1)
