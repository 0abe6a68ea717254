"""Uploads over links that lose a quarter of all messages each way: none fails. `make soak` does a hundred."""

from gcs.bench.lossy_transfers import measure_transfers


def test_no_upload_fails_and_most_are_verified_within_some_seconds() -> None:
    measured = measure_transfers(0.25, 10)
    assert measured.failed == 0
    assert measured.median_s < 5.0


def test_loss_costs_time() -> None:
    quiet, bad = measure_transfers(0.0, 1), measure_transfers(0.4, 5)
    assert bad.failed == quiet.failed == 0
    assert quiet.upload_median_s < quiet.median_s < bad.median_s
