"""Fair comparisons of searches: problems, best-known values, runs at equal budgets, statistics."""
