"""A process of endpoints, and each endpoint in it, seen from the station that started them."""

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess

from sitl.nest import run_nest
from sitl.process import ProcessConfig, run_process
from sitl.reports import Died, Ended, Failed, Hatched, Ready, Report


class EndpointProcess:
    """A process of endpoints, seen from the station.

    Args:
        config: of the process.
        reports: what it and its nest tell.

    Attributes:
        pid: its number, once it is known.
        exit_code: once it has ended, minus the number of the signal that ended it; None where nobody knows.
        ready, last: reports of its vehicles, by sysid.
    """

    def __init__(self, config: ProcessConfig, reports: Connection) -> None:
        self.config = config
        self.reports = reports
        self.pid: int | None = None
        self.exit_code: int | None = None
        self.ready: dict[int, Ready] = {}
        self.last: dict[int, Ended | Failed] = {}
        self._open = True

    @property
    def starting(self) -> bool:
        """Whether some of its vehicles are not ready yet."""
        return len(self.ready) < len(self.config.endpoints)

    def is_alive(self) -> bool:
        """Whether it has not ended yet; takes what it has reported so far."""
        try:
            while self._open and self.reports.poll():
                self._take(self.reports.recv())
        except (EOFError, OSError):
            self._open = False
        return self._open

    def _take(self, report: Report) -> None:
        match report:
            case Hatched(pid):
                self.pid = pid
            case Ready(sysid):
                self.ready[sysid] = report
            case Ended(sysid) | Failed(sysid):
                self.last[sysid] = report
            case Died(exit_code):
                self.exit_code = exit_code

    def terminate(self) -> None:
        """Ask it to end."""
        self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """End it by force."""
        self._signal(signal.SIGKILL)

    def _signal(self, number: signal.Signals) -> None:
        while self.is_alive() and self.pid is None:
            wait([self.reports])
        if self.is_alive() and self.pid is not None:
            with contextlib.suppress(ProcessLookupError):  # its nest is about to say so
                os.kill(self.pid, number)

    def end(self, deadline: float) -> None:
        """See the process, which was told to terminate, to its end: by force after the deadline (monotonic time)."""
        while self.is_alive() and (left_s := deadline - time.monotonic()) > 0.0:
            wait([self.reports], left_s)
        self.kill()
        while self.is_alive():
            wait([self.reports])
        self.reports.close()


def hatch(configs: Sequence[ProcessConfig]) -> tuple[list[EndpointProcess], BaseProcess]:
    """Start processes; returns them and the nest that they are forked from, which ends with the last of them."""
    context = multiprocessing.get_context("spawn")
    pipes = [context.Pipe(duplex=False) for _ in configs]
    ends = [end for _, end in pipes]
    nest = context.Process(target=run_nest, args=(run_process, configs, ends), name="skein-nest", daemon=True)
    with _deaf_children():
        nest.start()
    for end in ends:
        end.close()
    return [EndpointProcess(config, reports) for config, (reports, _) in zip(configs, pipes, strict=True)], nest


@dataclass
class Endpoint:
    """One vehicle, seen from the station.

    Attributes:
        sysid, name: of the vehicle.
        process: that it is in, alone or with others.
    """

    sysid: int
    name: str
    process: EndpointProcess

    @property
    def ready(self) -> Ready | None:
        """Where it answers, as soon as it does."""
        return self.process.ready.get(self.sysid)

    @property
    def last(self) -> Ended | Failed | None:
        """Its last report, when it has ended."""
        return self.process.last.get(self.sysid)

    def obituary(self) -> str | None:
        """Why the vehicle was lost; None while it flies. Not to be asked once the clock was told to stop."""
        alive = self.process.is_alive()
        if isinstance(self.last, Failed):
            return self.last.reason
        if isinstance(self.last, Ended):
            return f"process ended at tick {self.last.tick}, though nobody had stopped its clock"
        if alive:
            return None
        code = self.process.exit_code or 0
        return f"process killed by {signal.Signals(-code).name}" if code < 0 else f"process ended with code {code}"


@contextlib.contextmanager
def _deaf_children() -> Iterator[None]:
    """Processes started within this context ignore Ctrl-C and a closed terminal from their first moment on.

    They hit the whole group of processes, and it is the station that ends its endpoints.
    """
    signals = [getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)]
    if threading.current_thread() is not threading.main_thread():  # Python lets only that one change them
        yield
        return
    handlers = [(number, signal.signal(number, signal.SIG_IGN)) for number in signals]
    try:
        yield
    finally:
        for number, handler in handlers:
            signal.signal(number, handler)
