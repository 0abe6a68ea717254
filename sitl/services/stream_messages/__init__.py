"""A vehicle's state as MAVLink telemetry messages; `streams.STREAMS` is the list of them."""
