"""Many jobs through an executor of this machine's processes or a cluster's. A job that dies is named, the others go
on."""

from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")


@dataclass(frozen=True)
class Failure(Generic[Job]):
    """A job that gave no result, and why."""

    job: Job
    reason: str


class Workers(Protocol):
    """Where jobs run."""

    @property
    def at_once(self) -> int:
        """Jobs to have under way."""
        ...

    def opened(self, at_once: int) -> AbstractContextManager[Executor]:
        """A new executor of the concurrent.futures interface; nothing of it is left after the block, even if the block
        ends early."""
        ...


def run_jobs(
    jobs: Iterable[Job],
    workers: Workers,
    run: Callable[[Job], Result],
    done: Callable[[Result | Failure[Job]], None],
) -> None:
    """Run jobs, telling of each as it ends, in whatever order.

    A process that dies takes its executor with it, and nobody says which job it was. So those under way are run again,
    each alone, and which then dies again is to blame.

    Args:
        jobs: to be run; they and their results can be pickled.
        workers: that run them.
        run: runs one.
        done: called with what came of each.
    """
    waiting, suspects = deque(jobs), deque[Job]()
    while suspects or waiting:
        if not suspects:
            suspects.extend(_until_broken(waiting, workers, workers.at_once, run, done))
        else:
            for job in _until_broken(suspects, workers, 1, run, done):
                done(Failure(job, "its process died"))


def _until_broken(
    queue: deque[Job],
    workers: Workers,
    at_once: int,
    run: Callable[[Job], Result],
    done: Callable[[Result | Failure[Job]], None],
) -> list[Job]:
    """Run jobs from a queue in one executor until it is empty or the executor breaks; returns those then under way."""
    under_way: dict[Future[Result], Job] = {}
    broken: list[Job] = []
    with workers.opened(at_once) as executor:
        while (queue or under_way) and not broken:
            while queue and len(under_way) < at_once:
                try:
                    under_way[executor.submit(run, queue[0])] = queue[0]
                except BrokenExecutor:  # a process died that had nothing to do, or whose job is still to be heard of
                    return list(under_way.values())
                queue.popleft()
            finished, _ = wait(under_way, return_when=FIRST_COMPLETED)
            for future in finished:
                job = under_way.pop(future)
                error = future.exception()
                if isinstance(error, BrokenExecutor):
                    broken.append(job)
                elif error is not None:
                    done(Failure(job, f"{type(error).__name__}: {error}"))
                else:
                    done(future.result())
    return [*broken, *under_way.values()] if broken else []
