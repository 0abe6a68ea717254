"""Jobs on this machine: processes with one thread each, so that methods are compared fairly."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import wait

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""What keeps the libraries below numpy to one thread in a process that starts with them."""


@dataclass(frozen=True)
class Processes:
    """So many processes of this machine."""

    at_once: int

    @contextmanager
    def opened(self, at_once: int) -> Iterator[Executor]:
        """Processes from a forkserver: a fork of a process with numba's threads would die.

        They leave Ctrl-C, which reaches the whole group, to their parent, which ends them, and end with it when it is
        killed.
        """
        before = set(multiprocessing.active_children())
        with _one_thread():
            executor = ProcessPoolExecutor(
                at_once,
                mp_context=multiprocessing.get_context("forkserver"),
                initializer=_begin,
            )
            try:
                yield executor
            except BaseException:
                for process in set(multiprocessing.active_children()) - before:
                    process.terminate()
                executor.shutdown(wait=False, cancel_futures=True)
                raise
            executor.shutdown()


def _begin() -> None:
    """What each process does first."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    wait([parent.sentinel])
    os._exit(1)  # the pool's queues would never tell: this process holds both ends of them


@contextmanager
def _one_thread() -> Iterator[None]:
    """Processes started within have libraries that use one thread."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
