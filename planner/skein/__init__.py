"""Skein's own search for one UAV's path: starts in many homotopy classes, and descent by exact gradients."""
