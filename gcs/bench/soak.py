"""`make soak`: hostile traffic at full size, a process an end; writes the figures and fails when an end has grown."""

import json
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from multiprocessing import get_context
from pathlib import Path

from gcs.bench.fuzz import fuzz_endpoint, fuzz_station

PIECES = 1_000_000
SEED = 1
MOST_GROWN_MB = 20.0


def soak(out: Path) -> int:
    """Fuzz both ends, write `soak.json` into a folder; the exit code: 0 when neither has grown."""
    ends = {"endpoint": fuzz_endpoint, "station": fuzz_station}
    with ProcessPoolExecutor(len(ends), mp_context=get_context("spawn")) as workers:
        running = {name: workers.submit(fuzz, PIECES, SEED) for name, fuzz in ends.items()}
        figures = {name: asdict(future.result()) for name, future in running.items()}
    out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(figures, indent=1)
    (out / "soak.json").write_text(text + "\n", encoding="utf-8")
    print(text)
    return int(any(end["grown_mb"] > MOST_GROWN_MB for end in figures.values()))


if __name__ == "__main__":
    sys.exit(soak(Path("runs/soak")))
