"""What the verifier proves of all paths at once: limits that hold at every instant, by bounds between samples."""
