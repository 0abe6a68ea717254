"""What a path costs: the objective (3)-(11) and the constraints (12) for a whole population at once."""
