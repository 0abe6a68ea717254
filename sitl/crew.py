"""The vehicles of one process: who fails leaves, is reported by name, and the others go on."""

import contextlib
import threading
import traceback
from collections.abc import Callable, Iterable
from multiprocessing.connection import Connection

from zenoh import ZError

from missions.errors import InputError
from sitl.endpoint import Endpoint
from sitl.reports import Failed, Report

KILLED = "killed, as scheduled"


class Crew:
    """The endpoints of a process that go on. Used from the thread that steps them and from the one that serves them.

    Args:
        endpoints: of the process.
        reports: where the station hears of them.
        on_left: called when one has left, and with how many that go on.

    Attributes:
        flying: those that go on, by sysid; replaced, never changed, when one leaves.
    """

    def __init__(self, endpoints: Iterable[Endpoint], reports: Connection, on_left: Callable[[int, int], None]) -> None:
        self.flying = {endpoint.sysid: endpoint for endpoint in endpoints}
        self._reports = reports
        self._on_left = on_left
        self._lock = threading.Lock()

    def leave(self, endpoint: Endpoint, error: Exception) -> None:
        """A vehicle has failed, in whatever way."""
        with self._lock:
            if endpoint.sysid not in self.flying:
                return
            self.flying = {sysid: other for sysid, other in self.flying.items() if other is not endpoint}
        self.report(Failed(endpoint.sysid, reason(endpoint.sysid, error)))
        self._on_left(endpoint.sysid, len(self.flying))

    def fall(self, endpoint: Endpoint) -> None:
        """A vehicle fails as the scenario says. Its neighbours know when it falls silent: to them it stays there."""
        with self._lock:
            self.flying = {sysid: other for sysid, other in self.flying.items() if other is not endpoint}
        self.report(
            Failed(endpoint.sysid, f"vehicle {endpoint.sysid}: {KILLED}", endpoint.edges(), endpoint.yieldings())
        )

    def report(self, report: Report) -> None:
        """Tell the station; when it has gone there is nobody to tell."""
        with self._lock, contextlib.suppress(OSError):
            self._reports.send(report)


def reason(sysid: int, error: Exception) -> str:
    """Why a vehicle was lost, for people; the traceback of what nobody expects goes to standard error."""
    if not isinstance(error, InputError | OSError | ZError):
        traceback.print_exception(error)
    return f"vehicle {sysid}: {str(error) or type(error).__name__}"
