"""The command protocol: what a station may tell a vehicle to do, a file for each kind of command."""
