"""Searches behind one interface: they see a counted cost function in a box, start points and a random generator."""

from planner.search.minimize import minimize

__all__ = ["minimize"]
