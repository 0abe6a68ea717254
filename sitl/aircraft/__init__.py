"""The aircraft: a point mass with actuators, limits and gusts (MODEL, section 5). Plain floats in and out; everything
that runs each tick keeps to the dialect that plain Python and numba compute bit for bit alike."""
