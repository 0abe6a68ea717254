"""How bytes reach the vehicles and come back: one transport a file."""
