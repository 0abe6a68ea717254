"""Transfers between the station and one vehicle: state machines that are fed messages and ticks."""
