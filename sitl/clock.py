"""The swarm's clock in one endpoint: held, released, paced and stopped by the station (DESIGN, Time)."""

import json
import math
import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

import zenoh

from sitl.ticks import TICK_S
from sitl.zenoh_session import clock_key

MOST_BEHIND_S = 0.5
"""A paced clock that has fallen behind by more does not hurry to make up for it."""


class Clock:
    """Says when a tick may begin.

    Args:
        held: start held, at tick 0.
        speed: simulated seconds a wall second; infinite for as fast as it goes.
        on_stop: called once, from the thread that stops the clock.
    """

    def __init__(self, *, held: bool, speed: float, on_stop: Callable[[], None]) -> None:
        self.held = held
        self.speed = speed
        self.stopped = False
        self.tick = 0
        self._on_stop = on_stop
        self._changed = threading.Condition()
        self._anchor: tuple[int, float] | None = None

    @property
    def paced(self) -> bool:
        """Whether it keeps to a speed, rather than going as fast as it can."""
        return not math.isinf(self.speed)

    def wait_for(self, tick: int) -> bool:
        """Wait until a tick may begin; False when the clock has been stopped."""
        self.tick = tick
        if not (self.held or self.stopped or self.paced):
            return True
        with self._changed:
            while not self.stopped:
                if self.held:
                    self._anchor = None
                    self._changed.wait()
                    continue
                early = self._early_s(tick)
                if early <= 0.0:
                    return True
                self._changed.wait(early)
            return False

    def _early_s(self, tick: int) -> float:
        """How long before its time a tick would begin now."""
        if not self.paced:
            return 0.0
        now = time.monotonic()
        if self._anchor is None:
            self._anchor = (tick, now)
        start_tick, start = self._anchor
        early = start + (tick - start_tick) * TICK_S / self.speed - now
        if early < -MOST_BEHIND_S:
            self._anchor = (tick, now)
        return early

    def hold(self) -> None:
        """Stand still before the next tick."""
        self._set(held=True)

    def release(self) -> None:
        """Go on."""
        self._set(held=False)

    def pace(self, speed: float) -> None:
        """Change the speed factor, > 0; infinite for as fast as it goes."""
        self._set(speed=speed, _anchor=None)

    def stop(self) -> None:
        """End, at whatever tick."""
        if not self.stopped:
            self._set(stopped=True)
            self._on_stop()

    def _set(self, **values: Any) -> None:
        with self._changed:
            for name, value in values.items():
                setattr(self, name, value)
            self._changed.notify_all()


def serve_clock(session: zenoh.Session, swarm: str, sysids: Callable[[], Iterable[int]], clock: Clock) -> None:
    """Answer queries on the swarm's clock key with the state of each vehicle, or an error that says what was wrong.

    A query's payload is JSON: {"do": "hold" | "release" | "stop" | "state"}, and {"speed": number}, where 0 means as
    fast as it goes.

    Args:
        session: open.
        swarm: part of the key.
        sysids: gives the vehicles that go by this clock.
        clock: theirs.
    """

    def answer(query: zenoh.Query) -> None:
        try:
            request = json.loads(query.payload.to_bytes()) if query.payload is not None else {"do": "state"}
            _obey(clock, request)
        except (ValueError, TypeError, AttributeError) as error:
            query.reply_err(f"vehicle {', '.join(map(str, sysids()))}: {error}")
            return
        speed = clock.speed if clock.paced else 0.0
        state = {"tick": clock.tick, "held": clock.held, "speed": speed, "stopped": clock.stopped}
        for sysid in sysids():
            query.reply(clock_key(swarm), json.dumps({"sysid": sysid} | state))

    session.declare_queryable(clock_key(swarm), zenoh.handlers.Callback(answer, indirect=False))


def _obey(clock: Clock, request: Any) -> None:
    if "speed" in request:
        speed = float(request["speed"])
        if not speed >= 0.0:
            raise ValueError(f"speed must be 0 or more, got {speed:g}")
        clock.pace(speed or math.inf)
    action = request.get("do", "state")
    if action == "state":
        return
    if action not in ("hold", "release", "stop"):
        raise ValueError(f"no action {action!r}; there are hold, release, stop and state")
    getattr(clock, action)()
