"""Uploads between real processes over a relay that loses a quarter of all messages: `make soak` does a hundred."""

from gcs.bench.relayed_transfers import measure_relayed


def test_no_upload_over_real_sockets_fails_though_messages_of_many_kinds_are_lost() -> None:
    measured = measure_relayed(0.25, 4, n_items=40, delay_s=0.01, n_vehicles=2)
    assert (measured.uploads, measured.failed) == (4, 0)
    assert {"MISSION_ITEM_INT", "MISSION_REQUEST_INT"} <= set(measured.kinds_lost)
    assert 0.08 < measured.median_s <= measured.slowest_s  # eight delays are the least that it takes
