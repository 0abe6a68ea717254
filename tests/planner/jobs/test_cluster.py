"""Jobs on a Dask cluster: a real one of worker processes on loopback."""

import socket
import sys
from collections.abc import Iterator

import pytest
from distributed import LocalCluster

from missions.errors import InputError
from planner.bench.job import Job, Limit, Run, run_job
from planner.bench.problems import bench_problem
from planner.jobs import cluster
from planner.jobs.run_jobs import Failure, run_jobs


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", protocol="tcp", dashboard_address=":0"
    ) as local:
        yield local.scheduler_address


def test_runs_come_back_as_they_would_from_here_and_errors_by_name(address: str) -> None:
    problem = bench_problem("forest-5-1")
    wanted = [Job(problem.name, problem.digest, "pso", seed, Limit(20)) for seed in (1, 2, 3)]
    other_version = Job(problem.name, "0" * 16, "pso", 4, Limit(20))
    results: list[Run | Failure[Job]] = []
    workers = cluster.connect(address)
    assert workers.at_once == 4
    run_jobs([*wanted, other_version], workers, run_job, results.append)
    runs = {result.job: result for result in results if isinstance(result, Run)}
    assert set(runs) == set(wanted)
    assert runs[wanted[0]].lines[:, [0, 2]].tolist() == run_job(wanted[0]).lines[:, [0, 2]].tolist()
    (failure,) = (result for result in results if isinstance(result, Failure))
    assert failure.job == other_version


def test_workers_with_several_threads_are_refused() -> None:
    with (
        LocalCluster(
            n_workers=1, threads_per_worker=2, processes=False, host="127.0.0.1", protocol="tcp", dashboard_address=":0"
        ) as local,
        pytest.raises(InputError, match=r"has 2 threads.*--nthreads 1"),
    ):
        cluster.connect(local.scheduler_address)


@pytest.mark.parametrize("address", ["nonsense", "tcp://127.0.0.1:{}", "foo://127.0.0.1:1"])
def test_nobody_there(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "CONNECT_S", 0.5)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        there = address.format(free.getsockname()[1])
        with pytest.raises(InputError, match=f"--cluster {there}: no scheduler answers there"):
            cluster.connect(there)


def test_without_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'skein-gcs\[cluster\]'"):
        cluster.connect("tcp://127.0.0.1:8786")
