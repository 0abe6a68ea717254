"""Many jobs at once, on this machine's processes or on a cluster."""
