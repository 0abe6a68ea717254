"""Checking mission files before they are flown: on the way that an endpoint would fly, stage by stage."""
