"""The measurement of a station under load, at a size that any machine bears."""

import asyncio
from pathlib import Path

from gcs.bench.station_load import Load, listen
from gcs.tlog_reader import read_tlog


def test_every_frame_of_every_vehicle_is_heard_and_logged(tmp_path: Path) -> None:
    load = Load(vehicles=260, rate_hz=16.0, frames=8, seconds=2.0)
    result = asyncio.run(asyncio.wait_for(listen(load, tmp_path), 60.0))
    assert (result.heard, result.lost) == (260, 0)
    assert result.received == result.sent == 260 * 32
    logs = sorted(path.name for path in tmp_path.iterdir())
    assert len(logs) == 260
    assert {"0-250.tlog", "1-10.tlog"} <= set(logs)
    sysids = [one.message.get_srcSystem() for one in read_tlog(tmp_path / "1-10.tlog")]
    assert sysids.count(10) == 32
