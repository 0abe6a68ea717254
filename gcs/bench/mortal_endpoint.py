"""The process of an endpoint that is killed in the middle of what it keeps."""

import os
import signal
import threading
from collections.abc import Sequence
from itertools import count
from multiprocessing.connection import Connection
from types import FrameType
from typing import Any

from sitl import store
from sitl.endpoint import Endpoint
from sitl.process import ProcessConfig, run_process


def run_until_line(line: int, config: ProcessConfig, endpoints: Sequence[Endpoint], reports: Connection) -> None:
    """`run_process`, killed before a line of `sitl.store`: the first is 1, counted from when stations are served."""
    left = count(line - 1, -1)

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        if frame.f_code.co_filename != store.__file__:
            return None
        if event == "line" and next(left) == 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return trace

    threading.settrace(trace)  # in the thread that serves, which is started later
    run_process(config, endpoints, reports)
