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
        real_time: it is the wall's clock, `speed` times as fast: once released it keeps to it, whatever falls behind,
            and can neither be held nor paced.

    Attributes:
        on_stop: called once, from the thread that stops the clock.
        most_behind_s: wall time by which a tick of a clock in real time has begun too late, at the most.
    """

    def __init__(self, *, held: bool, speed: float, real_time: bool = False) -> None:
        self.held = held
        self.speed = speed
        self.most_behind_s = 0.0
        self._real_time = real_time
        self.stopped = False
        self.tick = 0
        self.on_stop: Callable[[], None] = lambda: None
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
        if self._real_time:
            self.most_behind_s = max(self.most_behind_s, -early)
        elif early < -MOST_BEHIND_S:
            self._anchor = (tick, now)
        return early

    def now_ticks(self) -> float:
        """The simulated time that it is now, in ticks, whatever tick has begun; for a clock that is paced."""
        if self._anchor is None:
            return float(self.tick)
        start_tick, start = self._anchor
        return start_tick + (time.monotonic() - start) * self.speed / TICK_S

    def hold(self) -> bool:
        """Stand still before the next tick; returns whether it did already. Raises ValueError in real time."""
        if self._real_time:
            raise ValueError("in real time the clock is the wall's, which nobody holds")
        with self._changed:
            was_held, self.held = self.held, True
        return was_held

    def release(self, at_s: float | None = None) -> None:
        """Go on.

        Args:
            at_s: when the next tick is to begin, UNIX time, so that it is one moment for all; None for at once.
        """
        if at_s is not None and not math.isfinite(at_s):
            raise ValueError(f"a clock is released at a moment, got {at_s}")
        if not self.held:
            return
        start = None if at_s is None else (self.tick, time.monotonic() + at_s - time.time())
        self._set(held=False, _anchor=start)

    def pace(self, speed: float) -> None:
        """Change the speed factor, > 0; infinite for as fast as it goes. Raises ValueError in real time."""
        if self._real_time:
            raise ValueError("in real time the clock is the wall's, and has the speed that it began with")
        self._set(speed=speed, _anchor=None)

    def stop(self) -> None:
        """End, at whatever tick."""
        if not self.stopped:
            self._set(stopped=True)
            self.on_stop()

    def _set(self, **values: Any) -> None:
        with self._changed:
            for name, value in values.items():
                setattr(self, name, value)
            self._changed.notify_all()


def serve_clock(session: zenoh.Session, swarm: str, sysids: Callable[[], Iterable[int]], clock: Clock) -> None:
    """Answer queries on the swarm's clock key with the state of each vehicle, or an error that says what was wrong.

    A query's payload is JSON: {"do": "hold" | "release" | "stop" | "state"}, and {"speed": number}, where 0 means as
    fast as it goes; with "release", {"at": UNIX time} names the moment at which the next tick begins. The answer to
    "hold" says in `was_held` whether the clock stood still already.

    Args:
        session: open.
        swarm: part of the key.
        sysids: gives the vehicles that go by this clock.
        clock: theirs.
    """

    def answer(query: zenoh.Query) -> None:
        try:
            request = json.loads(query.payload.to_bytes()) if query.payload is not None else {"do": "state"}
            told = _obey(clock, request)
        except (ValueError, TypeError, AttributeError) as error:
            query.reply_err(f"vehicle {', '.join(map(str, sysids()))}: {error}")
            return
        speed = clock.speed if clock.paced else 0.0
        state = {"tick": clock.tick, "held": clock.held, "speed": speed, "stopped": clock.stopped}
        for sysid in sysids():
            query.reply(clock_key(swarm), json.dumps({"sysid": sysid} | state | told))

    session.declare_queryable(clock_key(swarm), zenoh.handlers.Callback(answer, indirect=False))


def _obey(clock: Clock, request: Any) -> dict[str, bool]:
    """Do as asked; returns what there is to tell but the state."""
    if "speed" in request:
        speed = float(request["speed"])
        if not speed >= 0.0:
            raise ValueError(f"speed must be 0 or more, got {speed:g}")
        clock.pace(speed or math.inf)
    action = request.get("do", "state")
    if action == "state":
        return {}
    if action not in ("hold", "release", "stop"):
        raise ValueError(f"no action {action!r}; there are hold, release, stop and state")
    if action == "hold":
        return {"was_held": clock.hold()}
    if action == "release" and "at" in request:
        clock.release(float(request["at"]))
    else:
        getattr(clock, action)()
    return {}
