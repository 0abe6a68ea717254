"""MAVSDK as a ground station: one instance, the vehicles that it hears, their plans and actions."""

import queue
import time
from collections.abc import Collection, Sequence
from types import TracebackType
from typing import Any

from gcs.bench.peers import PATIENCE_S, peer_module
from missions.errors import InputError
from missions.mission import MissionItem
from missions.plan_type import PlanType


class MavsdkStation:
    """One MAVSDK instance. A context manager: at its end its connection is closed.

    Args:
        url: where it listens or connects, such as `udpin://127.0.0.1:14550` or `tcpout://127.0.0.1:5760`.

    Raises:
        InputError: MAVSDK is not installed, or the connection cannot be had.
    """

    def __init__(self, url: str) -> None:
        mavsdk = peer_module("mavsdk")
        kind = mavsdk.Configuration.create_with_component_type(mavsdk.ComponentType.GROUND_STATION)
        self._sdk = mavsdk.Mavsdk(kind)
        result = self._sdk.add_any_connection(url)
        if result != mavsdk.ConnectionResult.SUCCESS:
            self._sdk.destroy()
            raise InputError(f"MAVSDK: {url}: {result.name}")

    def wait_for(self, sysids: Collection[int], patience_s: float = PATIENCE_S) -> list[Any]:
        """Wait until it hears all these vehicles.

        Returns:
            MAVSDK's systems, in the order of `sysids`.

        Raises:
            TimeoutError: it does not hear some of them.
        """
        news: queue.SimpleQueue[None] = queue.SimpleQueue()
        subscription = self._sdk.subscribe_on_new_system(lambda _: news.put(None))
        deadline_s = time.monotonic() + patience_s
        try:
            while True:
                systems = {
                    system.get_system_id(): system for system in self._sdk.get_systems() if system.has_autopilot()
                }
                if systems.keys() >= set(sysids):
                    return [systems[sysid] for sysid in sysids]
                news.get(timeout=max(0.0, deadline_s - time.monotonic()))
        except queue.Empty:
            missing = sorted(set(sysids) - systems.keys())
            raise TimeoutError(f"MAVSDK did not hear vehicles {missing} within {patience_s:g} s") from None
        finally:
            self._sdk.unsubscribe_on_new_system(subscription)

    def __enter__(self) -> "MavsdkStation":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._sdk.destroy()


def plugin(name: str, system: Any) -> Any:
    """A plugin of MAVSDK, such as `action` or `mission_raw`, for one system."""
    module = peer_module(f"mavsdk.plugins.{name}.{name}")
    return getattr(module, "".join(word.title() for word in name.split("_")))(system)


def to_raw_items(items: Sequence[MissionItem], plan: PlanType = PlanType.MISSION) -> list[Any]:
    """Items as MAVSDK's raw missions take them: exactly the first of a mission is the current one."""
    make = peer_module("mavsdk.plugins.mission_raw.mission_raw").MissionItem
    return [
        make(
            seq,
            item.frame,
            item.command,
            int(seq == 0 and plan == PlanType.MISSION),
            int(item.autocontinue),
            *item.params,
            item.lat_e7,
            item.lon_e7,
            item.alt_m,
            int(plan),
        )
        for seq, item in enumerate(items)
    ]


def from_raw_items(raw: Sequence[Any]) -> tuple[MissionItem, ...]:
    """Items of MAVSDK's raw missions as Skein's."""
    return tuple(
        MissionItem(
            item.command,
            item.frame,
            item.param1,
            item.param2,
            item.param3,
            item.param4,
            item.x,
            item.y,
            item.z,
            bool(item.autocontinue),
        )
        for item in raw
    )
