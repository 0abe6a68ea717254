"""Collision avoidance beyond the plan: who will be where, who gives way, and how (docs/formation.md)."""
