"""From a scenario to a verified plan of nine paths. Knows no MAVLink."""
