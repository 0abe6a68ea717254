"""A process of endpoints, and each endpoint in it, seen from the station that started them."""

import contextlib
import multiprocessing
import signal
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from multiprocessing import forkserver
from multiprocessing.connection import wait
from multiprocessing.context import ForkServerProcess

from sitl.process import ProcessConfig, run_process
from sitl.reports import Ended, Failed, Ready


class EndpointProcess:
    """A process of endpoints, seen from the station. Starts at once.

    Args:
        config: of the process.
    """

    def __init__(self, config: ProcessConfig) -> None:
        self.config = config
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["sitl.process"])
        with _deaf_children():
            forkserver.ensure_running()
        self.reports, child_end = context.Pipe(duplex=False)
        sysids = [endpoint.vehicle.sysid for endpoint in config.endpoints]
        name = "skein-" + "-".join(map(str, sorted({sysids[0], sysids[-1]})))
        self.process: ForkServerProcess = context.Process(
            target=run_process, args=(config, child_end), name=name, daemon=True
        )
        self.process.start()
        child_end.close()
        self.ready: dict[int, Ready] = {}
        self.last: dict[int, Ended | Failed] = {}

    @property
    def starting(self) -> bool:
        """Whether some of its vehicles are not ready yet."""
        return len(self.ready) < len(self.config.endpoints)

    def read_reports(self) -> bool:
        """Take what the process has reported so far; whether more may come."""
        try:
            while self.reports.poll():
                report = self.reports.recv()
                if isinstance(report, Ready):
                    self.ready[report.sysid] = report
                else:
                    self.last[report.sysid] = report
        except (EOFError, OSError):
            return False
        return True

    def end(self, deadline: float) -> None:
        """See the process, which was told to terminate, to its end: by force after the deadline (monotonic time)."""
        while self.process.is_alive() and (left_s := deadline - time.monotonic()) > 0.0:
            if self.reports in wait([self.process.sentinel, self.reports], left_s) and not self.read_reports():
                self.process.join(left_s)  # its end of the pipe is closed, nothing more will come
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
        self.read_reports()
        self.reports.close()


@dataclass
class Endpoint:
    """One vehicle, seen from the station.

    Attributes:
        sysid, name: of the vehicle.
        owner: the process that it is in, alone or with others.
    """

    sysid: int
    name: str
    owner: EndpointProcess = field(repr=False)

    @property
    def process(self) -> ForkServerProcess:
        """The process that it is in."""
        return self.owner.process

    @property
    def ready(self) -> Ready | None:
        """Where it answers, as soon as it does."""
        return self.owner.ready.get(self.sysid)

    @property
    def last(self) -> Ended | Failed | None:
        """Its last report, when it has ended."""
        return self.owner.last.get(self.sysid)

    def obituary(self) -> str | None:
        """Why the vehicle was lost; None while it flies. Not to be asked once the clock was told to stop."""
        self.owner.read_reports()
        if isinstance(self.last, Failed):
            return self.last.reason
        if isinstance(self.last, Ended):
            return f"process ended at tick {self.last.tick}, though nobody had stopped its clock"
        if self.process.is_alive():
            return None
        code = self.process.exitcode or 0
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
