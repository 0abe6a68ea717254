"""`skein reproduce` from end to end, cut down."""

import json
import subprocess
import sys
from pathlib import Path

from matplotlib.image import imread

FIGURES = [f"figure-{number:02}.png" for number in range(4, 13)]
QUICK = ("--iterations", "10", "--count", "2", "--seeds", "1", "--no-flights")


def reproduce(out: Path, *more: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "gcs.main", "reproduce", "--out", str(out), *QUICK, *more]
    result = subprocess.run(command, capture_output=True, text=True, timeout=200)
    assert result.returncode == 0, result.stderr
    return result


def test_all_figures_and_tables_with_json_alone_on_standard_output(tmp_path: Path) -> None:
    out = tmp_path / "out"
    results = json.loads(reproduce(out, "--json").stdout)
    assert results == json.loads((out / "reproduction.json").read_text())
    assert [result["scenario"] for result in results] == ["mountains", "radars"]
    written = {name for result in results for name in result["figures"]}
    assert written == {*FIGURES, "methods-mountains.png", "methods-radars.png"}
    for name in written:
        assert imread(out / name)[..., :3].std() > 0.03
    for result in results:
        assert [row["name"] for row in result["table"]] == ["leader", "F1"]
        for row in result["table"]:
            assert row["planned_km"] >= row["straight_km"]
            assert row["hybrid_f_km"] >= row["planned_km"] - 0.01
            assert row["flown_km"] is None
