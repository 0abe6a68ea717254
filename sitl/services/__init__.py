"""A vehicle's MAVLink face: state machines that are fed messages, and the sockets that feed them."""
