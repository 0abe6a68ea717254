"""Losses over Zenoh: what a process's vehicles tell of whom they miss, and what the others do."""

import json
import queue
from collections.abc import Callable, Collection
from functools import partial

import zenoh

from sitl.loss_agreement import LossAgreement
from sitl.zenoh_session import losses_key

LAST_TICK = 1 << 31


def agree_over_zenoh(
    session: zenoh.Session,
    swarm: str,
    here: Collection[int],
    everyone: Collection[int],
    inbox: "queue.SimpleQueue[Callable[[], None]]",
    patience_ticks: int,
) -> LossAgreement:
    """An agreement whose vehicles tell and hear on `skein/<swarm>/<sysid>/losses`: {"missed": [...], "tick": n}, JSON.

    Args:
        session: open; closed by its owner.
        swarm: part of every key.
        here, everyone: vehicles of this process, and of the swarm.
        inbox: where Zenoh's threads put what is to be done in the owner's.
        patience_ticks: of the agreement.
    """
    publishers = {
        sysid: session.declare_publisher(
            losses_key(swarm, sysid), congestion_control=zenoh.CongestionControl.BLOCK, express=True
        )
        for sysid in here
    }

    def tell(sysid: int, missed: frozenset[int], tick: int) -> None:
        publishers[sysid].put(json.dumps({"missed": sorted(missed), "tick": tick}))

    agreement = LossAgreement(here, everyone, tell, patience_ticks)

    def hear(sysid: int, payload: bytes) -> None:
        if (told := _read(payload)) is not None and told[0] <= frozenset(everyone) - {sysid}:
            agreement.hear(sysid, *told)

    def put(sysid: int, sample: zenoh.Sample) -> None:
        inbox.put(partial(hear, sysid, sample.payload.to_bytes()))

    for sysid in set(everyone).difference(here):
        session.declare_subscriber(
            losses_key(swarm, sysid), zenoh.handlers.Callback(partial(put, sysid), indirect=False)
        )
    return agreement


def _read(payload: bytes) -> tuple[frozenset[int], int] | None:
    """Who is missed, and since which tick; None where that is not what it says."""
    try:
        told = json.loads(payload)
        missed, tick = frozenset(told["missed"]), told["tick"]
    except (ValueError, TypeError, KeyError):
        return None
    return (missed, tick) if isinstance(tick, int) and 0 <= tick < LAST_TICK else None
