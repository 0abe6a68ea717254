"""What planner, endpoints and ground station share: scenarios, geometry, missions and their file formats."""
