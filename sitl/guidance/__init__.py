"""Guidance: from a place beside the path, or beside a circle, to wanted accelerations (MODEL, section 6, Law)."""
