"""Hostile traffic of some seeds at both ends: neither breaks nor grows. `gcs.bench.fuzz` does the same at full size."""

from collections import Counter
from itertools import islice

import pytest

from gcs.bench.fuzz import fuzz_endpoint, fuzz_station
from gcs.bench.hostile_traffic import hostile_traffic
from sitl.services.codec import Codec
from sitl.services.received import KINDS

PIECES = 20_000


@pytest.mark.parametrize("seed", [1, 2])
def test_the_station_neither_breaks_nor_grows(seed: int) -> None:
    fuzzed = fuzz_station(PIECES, seed)
    assert fuzzed.through > PIECES / 20
    assert fuzzed.grown_mb < 20.0


@pytest.mark.parametrize("seed", [1, 2])
def test_an_endpoint_neither_breaks_nor_grows(seed: int) -> None:
    fuzzed = fuzz_endpoint(PIECES, seed)
    assert fuzzed.through > PIECES / 20
    assert fuzzed.grown_mb < 20.0


def test_the_traffic_is_the_same_for_a_seed_and_has_every_message() -> None:
    first, again = (list(islice(hostile_traffic(3, (3, 1), range(1, 9)), 10_000)) for _ in range(2))
    assert first == again
    names = Counter(message.get_type() for message in Codec(255, 190).feed(b"".join(first)))
    assert names.keys() == {kind.name for kind in KINDS.values()} - {"SETUP_SIGNING"}


def test_most_messages_with_a_target_are_aimed_at_it() -> None:
    messages = Codec(255, 190).feed(b"".join(islice(hostile_traffic(3, (77, 1), range(1, 9)), 2000)))
    aimed = [message for message in messages if hasattr(message, "target_system")]
    assert sum(message.target_system == 77 for message in aimed) > len(aimed) / 2
