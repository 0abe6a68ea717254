"""The ground station: command line, links, transfers, swarm operations, logs and reports."""
