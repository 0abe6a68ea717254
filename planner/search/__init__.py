"""Searches behind one interface: they see a cost function of a population, a budget and a random generator."""
