"""A whole swarm's flight in one process, compiled from the functions that endpoints run in plain Python."""

from sitl.rehearsal.rehearsal import Flown, rehearse

__all__ = ["Flown", "rehearse"]
