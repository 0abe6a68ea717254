"""Options of commands that run many jobs: how many processes, or which cluster."""

import os
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from planner.jobs.run_jobs import Workers

JobsOption = Annotated[
    int | None, typer.Option("--jobs", min=1, metavar="N", help="Processes; all cores unless given.")
]
ClusterOption = Annotated[
    str | None, typer.Option("--cluster", metavar="ADDRESS", help="A Dask scheduler to send the runs to.")
]


def chosen_workers(jobs: int | None, cluster: str | None) -> "Workers":
    """This machine's processes, or a cluster's. Raises InputError."""
    from missions.errors import InputError
    from planner.jobs.cluster import connect
    from planner.jobs.processes import Processes

    # A worker that is ended, as by Ctrl-C, leaves numba's lock to Python's tracker of such things, which tells of it.
    os.environ.setdefault("PYTHONWARNINGS", "ignore:resource_tracker")
    if cluster is None:
        return Processes(jobs or os.cpu_count() or 1)
    if jobs is not None:
        raise InputError("--jobs and --cluster: a cluster has as many workers as it has; choose one of them")
    return connect(cluster)
