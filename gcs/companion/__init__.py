"""Beside an autopilot that knows no formation law: its airspeed is commanded so that the swarm keeps together."""
