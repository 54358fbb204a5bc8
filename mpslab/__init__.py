"""mpslab: an incompressible particle wave tank.

>>> import mpslab
>>> case = mpslab.load_case("plunging_breaker", {"particles.spacing": 0.004})
>>> run = mpslab.Simulation(case).run()
>>> run.particles.position, run.gauges["time"]

A run that wrote files is read from its folder, at any time:

>>> run = mpslab.open_run("results")
>>> run.gauges["time"], run.frames[-1].position
"""

from mpslab.analysis.results import open_run
from mpslab.cases import load_case
from mpslab.core.keys import CaseError
from mpslab.core.plugins import add as add_model
from mpslab.instruments import Instrument
from mpslab.run.guard import RunFailed
from mpslab.simulation import Simulation

__version__ = "0.1.0"
__all__ = [
    "CaseError",
    "Instrument",
    "RunFailed",
    "Simulation",
    "add_model",
    "load_case",
    "open_run",
]
