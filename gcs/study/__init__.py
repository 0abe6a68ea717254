"""Studies: many rehearsed flights, and the linear law beside them, as tables and pictures."""
