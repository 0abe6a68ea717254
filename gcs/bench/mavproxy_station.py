"""MAVProxy, run as a process: commands go to its standard input, what it says comes back."""

import contextlib
import os
import re
import selectors
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType

from gcs.bench.peers import PATIENCE_S, peer_module

MODULES = "wp,param,fence,rally,mode,arm,cmdlong,misc"

_END_S = 5.0
_SHOWN = 2000
"""Characters of its last words in an error."""


class MavProxy:
    """A headless MAVProxy. A context manager: at its end the process is gone.

    Args:
        master: where it listens or connects, such as `udpin:127.0.0.1:14550`.
        folder: an empty folder, its home and working directory.

    Attributes:
        said: all that it has printed, as far as it has been read.

    Raises:
        InputError: MAVProxy is not installed.
    """

    def __init__(self, master: str, folder: Path) -> None:
        peer_module("MAVProxy")
        command = [sys.executable, "-u", "-m", "MAVProxy.mavproxy", f"--master={master}", "--no-state"]
        self.said = ""
        self._process = subprocess.Popen(
            [*command, f"--default-modules={MODULES}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            cwd=folder,
            env=os.environ | {"HOME": str(folder)},
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._input, self._output = self._process.stdin, self._process.stdout
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._output, selectors.EVENT_READ)

    def ask(self, command: str, answer: str, patience_s: float = PATIENCE_S) -> re.Match[str]:
        """Give a command and wait until it says something new that matches `answer`, a regular expression.

        Raises:
            TimeoutError: it did not; the message has what it said instead.
        """
        while self._read(0.0):
            pass
        start = len(self.said)
        self._input.write(f"{command}\n".encode())
        self._input.flush()
        return self.wait_for(answer, start, patience_s)

    def repeat(self, command: str, answer: str, *, every_s: float = 1.0) -> re.Match[str]:
        """Give a command again and again until the answer comes: for what a loss or MAVProxy itself holds up."""
        deadline_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline_s - every_s:
            with contextlib.suppress(TimeoutError):
                return self.ask(command, answer, every_s)
        return self.ask(command, answer, deadline_s - time.monotonic())

    def wait_for(self, answer: str, start: int = 0, patience_s: float = PATIENCE_S) -> re.Match[str]:
        """Wait until what it says from position `start` of `said` on matches; raises TimeoutError as `ask` does."""
        deadline_s = time.monotonic() + patience_s
        pattern = re.compile(answer)
        while (match := pattern.search(self.said, start)) is None:
            left_s = deadline_s - time.monotonic()
            if left_s <= 0.0 or (not self._read(left_s) and self._process.poll() is not None):
                raise TimeoutError(f"MAVProxy did not say {answer!r}; it said {self.said[start:][-_SHOWN:]!r}")
        return match

    def _read(self, timeout_s: float) -> bool:
        """Take what it says within `timeout_s`; whether there was anything."""
        if not self._selector.select(timeout_s):
            return False
        data = os.read(self._output.fileno(), 65536)
        self.said += data.decode(errors="replace").replace("\r", "")
        return bool(data)

    def __enter__(self) -> "MavProxy":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with contextlib.suppress(OSError):  # it may be gone already
            self._input.close()  # MAVProxy ends with its input
        try:
            self._process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._selector.close()
        self._output.close()
