"""Simulated fixed-wing aircraft: dynamics, guidance, formation law and their MAVLink and Zenoh faces."""
