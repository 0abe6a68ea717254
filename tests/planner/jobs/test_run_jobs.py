"""Jobs on processes: all come back, whatever happens to some."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from planner.bench.job import Job, Limit, Run, run_job
from planner.bench.problems import bench_problem
from planner.jobs.processes import Processes
from planner.jobs.run_jobs import Failure, run_jobs

SMALL = Limit(20)


def jobs(*names: str, seeds: int = 2) -> list[Job]:
    return [Job(name, bench_problem(name).digest, "pso", seed, SMALL) for name in names for seed in range(1, seeds + 1)]


def children() -> set[multiprocessing.process.BaseProcess]:
    return set(multiprocessing.active_children())


def test_two_processes_give_what_one_gives_and_errors_by_name() -> None:
    wanted = jobs("radars-F2", "forest-5-1")
    bad = [replace(wanted[0], digest="0" * 16), replace(wanted[0], method="none")]
    results: list[Run | Failure[Job]] = []
    run_jobs([bad[0], *wanted, bad[1]], Processes(2), run_job, results.append)
    runs = {result.job: result for result in results if isinstance(result, Run)}
    assert set(runs) == set(wanted)
    for job, run in runs.items():
        assert 0 < run.evaluations <= SMALL.evaluations_per_dimension * bench_problem(job.problem).dimension
    here, there = run_job(wanted[0]), runs[wanted[0]]
    assert here.lines[:, [0, 2]].tolist() == there.lines[:, [0, 2]].tolist()
    assert there.path_m is not None
    failures = {result.job: result.reason for result in results if isinstance(result, Failure)}
    assert set(failures) == set(bad)
    assert "another version of skein?" in failures[bad[0]]


def test_a_killed_process_takes_no_job_with_it() -> None:
    """Its jobs run again, alone; only what dies again is to blame."""
    before, results = children(), []

    def kill_one(result: Run | Failure[Job]) -> None:
        if not results:
            pid = next(iter(children() - before)).pid
            assert pid is not None
            os.kill(pid, signal.SIGKILL)
        results.append(result)

    wanted = jobs("forest-5-1", seeds=4)
    run_jobs(wanted, Processes(2), run_job, kill_one)
    assert sorted(result.job.seed for result in results) == [1, 2, 3, 4]
    assert all(isinstance(result, Run) for result in results)


class Deadly(Executor):
    """Runs at once, and breaks for good at one seed, as a process that dies would."""

    broken = False

    def submit(self, fn, /, job):  # type: ignore[no-untyped-def, override]
        if self.broken:
            raise BrokenExecutor
        future: Future[Run] = Future()
        self.broken = job.seed == 3
        if self.broken:
            future.set_exception(BrokenExecutor())
        else:
            future.set_result(fn(job))
        return future


class Deadlies:
    at_once = 2

    @contextmanager
    def opened(self, at_once: int) -> Iterator[Executor]:
        yield Deadly()


def test_the_job_that_kills_its_process_is_named() -> None:
    done: list[Run | Failure[Job]] = []
    wanted = jobs("forest-5-1", seeds=5)
    run_jobs(wanted, Deadlies(), lambda job: Failure(job, "fine"), done.append)
    reasons = {result.job.seed: result.reason for result in done if isinstance(result, Failure)}
    assert reasons == {1: "fine", 2: "fine", 3: "its process died", 4: "fine", 5: "fine"}


def test_an_interrupt_leaves_no_process() -> None:
    before = children()

    def interrupt(result: Run | Failure[Job]) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_jobs(jobs("forest-5-1", seeds=20), Processes(2), run_job, interrupt)
    for process in children() - before:
        process.join(timeout=20)
    assert children() == before


ORPHANS = """
from planner.jobs.processes import Processes
import os, time
if __name__ == "__main__":
    with Processes(2).opened(2) as executor:
        executor.submit(time.sleep, 1000.0)
        print(executor.submit(os.getpid).result(), flush=True)
        time.sleep(1000.0)
"""


def test_processes_end_with_a_parent_that_is_killed(tmp_path: Path) -> None:
    script = tmp_path / "parent.py"
    script.write_text(ORPHANS)
    with subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        worker = int(parent.stdout.readline())
        parent.kill()
    deadline = time.monotonic() + 30.0
    while alive(worker):
        assert time.monotonic() < deadline, "it lives on"
        time.sleep(0.02)


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False
