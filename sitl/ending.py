"""How an endpoint ends before its time: told to by SIGTERM, or because the station that started it has gone."""

import os
import signal
import threading
import time
from collections.abc import Callable
from multiprocessing import parent_process
from multiprocessing.connection import wait

LAST_WORDS_S = 2.0
"""To end in good order when the station has gone."""


class Ending:
    """Watches for the end in threads of its own: a Python signal handler would have to wait for the main thread, which
    may be waiting itself.

    Made before any other thread, so that none of them takes the signal.

    Args:
        stop: called when the end has come; may be replaced as soon as there is more to stop.
    """

    def __init__(self, stop: Callable[[], None]) -> None:
        self.stop = stop
        if hasattr(signal, "pthread_sigmask"):  # elsewhere nobody sends SIGTERM
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
            threading.Thread(target=self._on_sigterm, daemon=True, name="sigterm").start()
        threading.Thread(target=self._with_parent, daemon=True, name="parent").start()

    def _on_sigterm(self) -> None:
        signal.sigwait({signal.SIGTERM})
        self.stop()

    def _with_parent(self) -> None:
        parent = parent_process()
        if parent is None:
            return
        wait([parent.sentinel])
        self.stop()
        time.sleep(LAST_WORDS_S)
        os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))
