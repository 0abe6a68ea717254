"""All searches by name. **To add a method, add it to `METHODS`.**"""

from planner.search.hybrid import hybrid
from planner.search.objective import Search
from planner.search.peers.cmaes import cmaes
from planner.search.peers.differential_evolution import differential_evolution
from planner.search.peers.lshade import lshade
from planner.search.peers.pyswarms import pyswarms
from planner.search.pso import pso
from planner.search.published import published
from planner.search.qpso import qpso
from planner.search.skein import skein

METHODS: dict[str, Search] = {
    "skein": skein,
    "pso": pso,
    "qpso": qpso,
    "hybrid": hybrid,
    "published": published,
    "de": differential_evolution,
    "cmaes": cmaes,
    "lshade": lshade,
    "pyswarms": pyswarms,
}
