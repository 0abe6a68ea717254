"""`skein rehearse` as its users meet it; that it flies as endpoints do is `test_demo.py`'s."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

SKEIN = (sys.executable, "-m", "gcs.main", "rehearse")


def skein(*arguments: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([*SKEIN, *map(str, arguments)], capture_output=True, text=True, timeout=200)


def rows_of(table: Path) -> list[dict[str, str]]:
    with table.open(newline="") as file:
        return list(csv.DictReader(file))


def test_a_campaign_that_was_killed_goes_on_where_it_was(short_scenario: Path, tmp_path: Path) -> None:
    out = tmp_path / "campaign"
    table = out / "runs.csv"
    axes = ("--delay", "0.2,0.4", "--jobs", 2, "--out", out)
    killed = subprocess.Popen([*SKEIN, short_scenario, *map(str, axes), "--runs", "100000"], stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 150.0
    while not table.exists() or table.read_bytes().count(b"\n") < 6:
        assert killed.poll() is None, "it has ended early"
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.02)
    os.kill(killed.pid, signal.SIGKILL)
    killed.wait()
    before = table.read_bytes()
    kept = before[: before.rfind(b"\n") + 1]
    runs = 2 + max(int(row["seed"]) for row in rows_of(table) if row["trajectory_sha256"])

    result = skein(short_scenario, *axes, "--runs", runs, "--json", "--parquet")
    assert result.returncode == 0, result.stderr
    assert table.read_bytes().startswith(kept)
    rows = rows_of(table)
    assert sorted((int(row["seed"]), row["formation.delay_s"]) for row in rows) == [
        (seed, delay) for seed in range(1, runs + 1) for delay in ("0.2", "0.4")
    ]
    assert len({row["trajectory_sha256"] for row in rows}) == 2 * runs
    printed = json.loads(result.stdout)
    assert (printed["flights"], printed["failed"]) == (2 * runs, 0)
    assert [setting["values"] for setting in printed["settings"]] == [
        {"formation.delay_s": "0.2"},
        {"formation.delay_s": "0.4"},
    ]
    assert (out / "figures" / "campaign-formation-delay_s.png").exists()

    from pyarrow import parquet

    columns = parquet.read_table(out / "runs.parquet").to_pydict()
    assert columns["rms_error_m"] == [float(row["rms_error_m"]) for row in rows]
    assert columns["formation.delay_s"] == [float(row["formation.delay_s"]) for row in rows]

    other = skein("vee", *axes, "--runs", 1)
    assert other.returncode == 2
    assert "its rows are of another campaign: scenario is" in other.stderr


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--vary", "formation.delay=0.1"), "formation.delay: cannot vary with one plan"),
        (("--delay", "-1"), "formation.delay_s: "),
        (("--delay", "0.1", "--vary", "formation.delay_s=0.2"), "formation.delay_s: is given twice"),
        (("--jobs", "2"), "are for campaigns"),
        (("--runs", "2", "--jobs", "2", "--cluster", "tcp://127.0.0.1:1"), "choose one of them"),
    ],
)
def test_what_cannot_be_is_one_line_and_2(options: tuple[str, ...], message: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    result = skein("vee", *options, "--out", out)
    assert result.returncode == 2
    assert result.stdout == ""
    (line,) = result.stderr.strip().splitlines()
    assert message in line
    assert not out.exists()
