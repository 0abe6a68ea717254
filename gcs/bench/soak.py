"""`make soak`: hostile traffic, lossy links, killed ends, and flights in which things fail, at full size; writes the
figures, and fails when an end has grown, an upload has not come through, a kill has left something else than a whole
plan, vehicles have collided or not arrived, corrections are worth less than they should be, or a rehearsal is not the
flight bit for bit."""

import json
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from multiprocessing import get_context
from pathlib import Path

from gcs.bench.equality import measure_equality
from gcs.bench.flown_often import measure_arms, measure_faults
from gcs.bench.fuzz import fuzz_endpoint, fuzz_station
from gcs.bench.killed_transfers import measure_kills
from gcs.bench.lossy_transfers import measure_transfers
from gcs.bench.relayed_transfers import measure_relayed

PIECES = 1_000_000
SEED = 1
MOST_GROWN_MB = 20.0
LOSSES = (0.0, 0.1, 0.25, 0.4)
UPLOADS = 100
ITEMS_OF_KILLED = 8
RELAYED_LOSS = 0.25


def soak(out: Path) -> int:
    """Do it all and write `soak.json` into a folder; the exit code: 0 when nothing fell short."""
    ends = {"endpoint": fuzz_endpoint, "station": fuzz_station}
    with ProcessPoolExecutor(len(ends), mp_context=get_context("spawn")) as workers:
        running = {name: workers.submit(fuzz, PIECES, SEED) for name, fuzz in ends.items()}
        transfers = [asdict(measured) for measured in workers.map(measure_transfers, LOSSES, [UPLOADS] * len(LOSSES))]
        fuzzed = {name: asdict(future.result()) for name, future in running.items()}
    relayed = asdict(measure_relayed(RELAYED_LOSS, UPLOADS))  # by itself: it takes wall time
    kills = {who: asdict(kills) for who, kills in measure_kills(ITEMS_OF_KILLED).items()}
    faults, arms, equality = measure_faults(), measure_arms(), measure_equality()
    figures = {
        **fuzzed,
        "transfers": transfers,
        "relayed": relayed,
        "kills": kills,
        "faults": [asdict(campaign) for campaign in faults],
        "arms": [worth.as_json() for worth in arms],
        "equality": [asdict(one) for one in equality],
    }
    out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(figures, indent=1)
    (out / "soak.json").write_text(text + "\n", encoding="utf-8")
    print(text)
    grown = any(end["grown_mb"] > MOST_GROWN_MB for end in fuzzed.values())
    failed = any(measured["failed"] for measured in [*transfers, relayed])
    failed |= not all(campaign.passed for campaign in faults)
    failed |= not all(worth.beats_plain and worth.beats_own for worth in arms)
    failed |= not all(one.same for one in equality)
    return int(grown or failed or any(killed["neither"] for killed in kills.values()))


if __name__ == "__main__":
    sys.exit(soak(Path("runs/soak")))
