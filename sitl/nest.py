"""The process that a swarm's processes are forked from, with all vehicles built and their sockets open.

A forked process has memory of its own only where it writes, be it a count of references: what has been made before is
there once for all.
"""

import contextlib
import gc
import os
import signal
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection

from sitl.crew import reason
from sitl.endpoint import Endpoint
from sitl.process import ProcessConfig
from sitl.reports import Died, Failed, Hatched, Report

Run = Callable[[ProcessConfig, Sequence[Endpoint], Connection], None]
"""What a process does: with what it is told, its vehicles, and where the station hears of it."""


@dataclass(frozen=True)
class Egg:
    """A process to be.

    Attributes:
        config: what it is told.
        reports: where the station hears of it.
        endpoints: its vehicles.
    """

    config: ProcessConfig
    reports: Connection
    endpoints: list[Endpoint]

    def leave(self) -> None:
        """Close what only the process itself is to have open."""
        for endpoint in self.endpoints:
            endpoint.links.close()
            endpoint.close()


def run_nest(run: Run, configs: Sequence[ProcessConfig], reports: Sequence[Connection]) -> None:
    """Build the vehicles of some processes, fork these, and report how each ends, until the last has.

    Args:
        run: what they do.
        configs, reports: of each.
    """
    for name in ("SIGINT", "SIGHUP"):  # Ctrl-C and a closed terminal hit the whole group; the station stops us
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    eggs = [Egg(config, report, _build(config, report)) for config, report in zip(configs, reports, strict=True)]
    gc.freeze()  # a collection would write to all that it looks at
    living = {_fork(run, egg, eggs): egg.reports for egg in eggs if egg.endpoints}
    for egg in eggs:
        egg.leave()
        if not egg.endpoints:
            egg.reports.close()
    while living:
        pid, status = os.wait()
        with living.pop(pid) as report:
            _tell(report, Died(os.waitstatus_to_exitcode(status)))


def _build(config: ProcessConfig, reports: Connection) -> list[Endpoint]:
    """The vehicles of a process; none, and the station knows why, when one of them cannot be built."""
    endpoints: list[Endpoint] = []
    for one in config.endpoints:
        try:
            endpoints.append(Endpoint(one))
        except Exception as error:
            why = reason(one.vehicle.sysid, error)
            for lost in config.endpoints:
                _tell(reports, Failed(lost.vehicle.sysid, why))
            return []
    return endpoints


def _fork(run: Run, egg: Egg, eggs: Sequence[Egg]) -> int:
    """The number of a new process that runs, and ends with that."""
    if pid := os.fork():
        return pid
    code = 1
    try:
        for other in eggs:
            if other is not egg:
                other.leave()
                other.reports.close()
        _tell(egg.reports, Hatched(os.getpid()))
        run(egg.config, egg.endpoints, egg.reports)
        code = 0
    finally:
        os._exit(code)


def _tell(reports: Connection, news: Report) -> None:
    with contextlib.suppress(OSError):  # the station has gone
        reports.send(news)
