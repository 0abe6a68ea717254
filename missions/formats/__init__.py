"""Mission files that other ground stations read: one format a file."""
