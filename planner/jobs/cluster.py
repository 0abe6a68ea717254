"""Jobs on a cluster: a Dask scheduler and its workers, through the interface of concurrent.futures."""

import asyncio
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from missions.errors import InputError

CONNECT_S = 10.0
"""How long a scheduler may take to answer, and a first worker to show up."""
AHEAD = 2
"""Jobs under way for each worker, so that none waits for the next."""


@dataclass(frozen=True)
class Cluster:
    """The workers of a scheduler.

    Attributes:
        address: of the scheduler, such as tcp://10.0.0.1:8786.
        at_once: jobs to have under way.
    """

    address: str
    at_once: int

    @contextmanager
    def opened(self, at_once: int) -> Iterator[Executor]:
        """An executor on the cluster; jobs still under way are cancelled when the block ends early."""
        with _client(self.address) as client:
            executor = client.get_executor(pure=False)
            try:
                yield executor
            except BaseException:
                executor.shutdown(wait=False)
                raise
            executor.shutdown()


def connect(address: str) -> Cluster:
    """The cluster of a scheduler.

    Raises:
        InputError: the extra is missing, nobody answers there, or its workers cannot take jobs.
    """
    with _client(address) as client:
        try:
            client.wait_for_workers(1, timeout=CONNECT_S)
        except TimeoutError:
            raise InputError(
                f"--cluster {address}: no worker within {CONNECT_S:g} s; start one with `dask worker`"
            ) from None
        workers: dict[str, Any] = client.scheduler_info(n_workers=-1)["workers"]
        for name, worker in workers.items():
            if worker["nthreads"] != 1:
                raise InputError(
                    f"--cluster {address}: worker {name} has {worker['nthreads']} threads, which spoils CPU times; "
                    "start workers with --nthreads 1"
                )
        return Cluster(address, AHEAD * len(workers))


@contextmanager
def _client(address: str) -> Iterator[Any]:
    try:
        from distributed import Client
        from distributed.comm.core import connect as knock
    except ImportError:
        raise InputError("--cluster: needs dask's distributed; pip install 'skein-gcs[cluster]'") from None

    async def answers() -> None:
        comm = await knock(address, timeout=CONNECT_S)
        await comm.close()

    try:
        asyncio.run(answers())  # a client that gets no answer leaves noise behind
    except (OSError, ValueError) as error:
        raise InputError(f"--cluster {address}: no scheduler answers there: {error}") from None
    with Client(address, timeout=CONNECT_S, set_as_default=False) as client:
        yield client
