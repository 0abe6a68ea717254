"""An order to vehicles in the air goes out at once: no planner, compiler or scenario is loaded first."""

import subprocess
import sys
from collections.abc import Callable

HEAVY = ("numba", "scipy", "matplotlib", "planner", "missions.scenario")
SHOWN = f"""
import atexit, sys
from gcs.main import main
atexit.register(lambda: print("loaded:", *(name for name in {HEAVY} if name in sys.modules)))
main()
"""


def test_an_operator_s_command_loads_nothing_heavy(free_port: Callable[[], int]) -> None:
    for order in ("abort", "status"):
        url = f"udpin://127.0.0.1:{free_port()}"
        command = [sys.executable, "-c", SHOWN, order, "--vehicle", "1", "--wait", "0.1", "--connect", url]
        ended = subprocess.run(command, capture_output=True, text=True, check=False)
        assert ended.returncode == 1, ended.stderr  # nobody is there, which it says in its table
        assert ended.stdout.splitlines()[-1] == "loaded:"
