"""Several vehicles in one process fly as they do in processes of their own."""

import asyncio
import struct
from pathlib import Path

from gcs.flight import FlightOptions, fly
from gcs.run_folder import make_run_folder
from missions.scenario import load_scenario
from planner.plan import plan

ROW = struct.Struct("<6d")


def test_a_flight_is_the_same_bit_for_bit_however_many_vehicles_share_a_process(
    short_scenario: Path, tmp_path: Path
) -> None:
    scenario = load_scenario(str(short_scenario))
    planned = plan(scenario)
    tracks = {}
    for size in (1, 2, 3):
        run = make_run_folder(tmp_path / str(size), scenario.name)
        run.write_plan(short_scenario.read_text(), scenario, planned)
        options = FlightOptions(delay_s=0.2, per_process=size)
        record = asyncio.run(fly(scenario, planned, run, options, lambda _: None, lambda _: None))
        assert record.lost == {}
        rows = int(min(one.duration_s for one in planned.references(scenario).values()) / 0.04)
        tracks[size] = {
            file.name: list(ROW.iter_unpack(file.read_bytes()[: rows * ROW.size])) for file in run.truth.iterdir()
        }
    assert tracks[1] == tracks[2] == tracks[3]
    assert len(tracks[1]) == 3
    assert all(len(set(track)) > 1000 for track in tracks[1].values()), "they flew"
