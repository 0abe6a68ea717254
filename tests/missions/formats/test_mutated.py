"""Damaged files: each is refused in one line that says where, or read as what stands in it.

"As what stands in it": every item, area and rally point that a plain JSON parser or a split of the row finds under the
keys and columns of the format is in the plan, value by value; what is missing has the value that is written down here;
and a key that is not known is said in a note. Nothing else may come out, and no other error.
"""

import json
import math
import random
import re
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from missions.errors import InputError
from missions.fence import FencePolygon
from missions.formats.mission_file import MissionFile, read_mission_file

GOOD = Path(__file__).parent / "corpus" / "good"
SEED = 20240611
PLANS, ROWS = 120, 80
WHERE = re.compile(r"(line \d+|byte \d+|item \d+ \(|row 0|home|no row 0|QGC WPL|not a plan|the file|[\w.\[\]]+: )")
STRANGE = ["x", "null", [], {}, True, None, -1, 1e30, -1e300, 10**40, 0.5, 7, math.nan, math.inf]


def flipped(text: str, chance: random.Random) -> bytes:
    content = bytearray(text.encode())
    for _ in range(chance.randint(1, 3)):
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    return bytes(content)


def truncated(text: str, chance: random.Random) -> bytes:
    return text.encode()[: chance.randrange(len(text))]


def renamed(text: str, chance: random.Random) -> bytes:
    key = chance.choice(list(re.finditer(r'"(\w+)":', text)))
    return (text[: key.start()] + f'"{key[1][:-1]}q":' + text[key.end() :]).encode()


def replaced(text: str, chance: random.Random) -> bytes:
    """Some value, anywhere in the tree, by one of another kind."""
    root = json.loads(text)
    places = list(walk(root))
    holder, key = chance.choice(places)
    holder[key] = chance.choice(STRANGE)
    return json.dumps(root).encode()


def walk(value: Any) -> Any:
    entries = value.items() if isinstance(value, dict) else enumerate(value)
    for key, inner in entries:
        yield value, key
        if isinstance(inner, (dict, list)):
            yield from walk(inner)


def field_replaced(text: str, chance: random.Random) -> bytes:
    fields = list(re.finditer(r"[^\s]+", text))
    field = chance.choice(fields)
    value = chance.choice(["nan", "inf", "-1", "1e30", "1e300", "99999999999", "x", "0.5", "", "0x10", "3", "1,5"])
    return (text[: field.start()] + value + text[field.end() :]).encode()


PLAN_MUTATIONS = (flipped, truncated, renamed, replaced)
ROW_MUTATIONS = (flipped, truncated, field_replaced)


def f32(value: float | None) -> str:
    """In words, so that NaN equals NaN."""
    return "nan" if value is None or math.isnan(value) else repr(struct.unpack("<f", struct.pack("<f", value))[0])


def in_words(command: float, frame: float, params: list[Any], lat: Any, lon: Any, alt: Any, goes_on: Any) -> list[Any]:
    frame = {5: 0, 6: 3, 11: 10}.get(int(frame), int(frame))
    scale = 1.0 if frame == 2 else 1e7 if frame in (0, 3, 10) else 1e4
    return [
        int(command),
        frame,
        *map(f32, params),
        round((lat or 0) * scale),
        round((lon or 0) * scale),
        f32(alt),
        bool(goes_on),
    ]


def items_read(found: MissionFile) -> list[list[Any]]:
    return [
        [item.command, item.frame, *map(f32, item.params), item.lat_e7, item.lon_e7, f32(item.alt_m), item.autocontinue]
        for item in found.plan.mission
    ]


def check_plan(content: bytes, found: MissionFile) -> None:
    root = json.loads(content)
    mission = root["mission"]
    expected = [in_words(16, 0, [0, 0, 0, 0], *mission["plannedHomePosition"], True)]
    for item in mission["items"]:
        params = item["params"]
        altitude = params[6] if params[6] is not None else item.get("Altitude")
        expected.append(
            in_words(item["command"], item["frame"], params[:4], *params[4:6], altitude, item.get("autoContinue", True))
        )
    assert items_read(found) == expected
    fence = root.get("geoFence") or {}
    areas = [area for key in ("polygons", "circles") for area in fence.get(key, [])]
    assert len(found.plan.fence.areas) == len(areas)
    for area, told in zip(found.plan.fence.areas, areas, strict=True):
        assert area.inclusion is told["inclusion"]
        if isinstance(area, FencePolygon):
            assert area.vertices == tuple((round(lat * 1e7), round(lon * 1e7)) for lat, lon in told["polygon"])
        else:
            lat, lon = told["circle"]["center"]
            assert (*area.center, area.radius_m) == (round(lat * 1e7), round(lon * 1e7), told["circle"]["radius"])
    back = fence.get("breachReturn")
    assert found.plan.fence.return_point == (None if back is None else tuple(round((v or 0) * 1e7) for v in back[:2]))
    rally = (root.get("rallyPoints") or {}).get("points", [])
    assert [(p.lat_e7, p.lon_e7, f32(p.alt_m)) for p in found.plan.rally] == [
        (round(lat * 1e7), round(lon * 1e7), f32(alt)) for lat, lon, alt in rally
    ]


def check_rows(content: bytes, found: MissionFile) -> None:
    lines = content.decode("utf-8-sig").splitlines()[1:]
    rows = [line.split() for line in lines if line.strip() and not line.strip().startswith("#")]
    values = [[float(text) for text in row] for row in rows]
    expected = [in_words(row[3], row[2], row[4:8], *row[8:11], row[11]) for row in values]
    expected[0] = in_words(16, 0, [0, 0, 0, 0], *values[0][8:11], True)
    assert items_read(found) == expected


@pytest.mark.parametrize(
    ("names", "mutations", "check", "count"),
    [
        (("qgc_4.plan", "above_terrain.plan", "camera.plan"), PLAN_MUTATIONS, check_plan, PLANS),
        (("mission_planner.waypoints", "mavproxy.txt", "int_frames.waypoints"), ROW_MUTATIONS, check_rows, ROWS),
    ],
    ids=["plan", "waypoints"],
)
def test_a_damaged_file_is_refused_with_its_place_or_read_as_what_stands_in_it(
    tmp_path: Path,
    names: tuple[str, ...],
    mutations: tuple[Callable[[str, random.Random], bytes], ...],
    check: Callable[[bytes, MissionFile], None],
    count: int,
) -> None:
    chance = random.Random(SEED)
    outcomes = {"read": 0, "refused": 0}
    for number in range(count):
        text = (GOOD / chance.choice(names)).read_text(encoding="utf-8")
        content = chance.choice(mutations)(text, chance)
        path = tmp_path / f"{number}"
        path.write_bytes(content)
        try:
            found = read_mission_file(path)
        except InputError as error:
            said = str(error)
            assert said.startswith(f"{path}: "), said
            assert "\n" not in said
            assert WHERE.match(said.removeprefix(f"{path}: ")), said
            outcomes["refused"] += 1
        else:
            check(content, found)
            outcomes["read"] += 1
    assert min(outcomes.values()) > count // 10, outcomes  # neither is rare, or the test has lost its point


def test_a_renamed_key_is_refused_or_said(tmp_path: Path) -> None:
    text = (GOOD / "qgc_4.plan").read_text(encoding="utf-8")
    for number, key in enumerate(re.finditer(r'"(\w+)":', text)):
        path = tmp_path / f"{number}.plan"
        path.write_text(text[: key.start()] + f'"{key[1][:-1]}q":' + text[key.end() :], encoding="utf-8")
        try:
            notes = read_mission_file(path).notes
        except InputError:
            continue
        assert any(f'"{key[1][:-1]}q"' in note for note in notes), key[1]
