"""mpslab: an incompressible particle wave tank.

>>> import mpslab
>>> case = mpslab.load_case("plunging_breaker", {"particles.spacing": 0.004})
>>> run = mpslab.Simulation(case).run()
>>> run.particles.position, run.gauges["time"]

A run that wrote files is read from its folder, at any time:

>>> run = mpslab.open_run("results")
>>> run.gauges["time"], run.frames[-1].position
"""

from mpslab.later import names_of

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
__getattr__, __dir__ = names_of(
    __name__,
    {
        "CaseError": "mpslab.core.keys:CaseError",
        "Instrument": "mpslab.instruments:Instrument",
        "RunFailed": "mpslab.run.guard:RunFailed",
        "Simulation": "mpslab.simulation:Simulation",
        "add_model": "mpslab.core.plugins:add",
        "load_case": "mpslab.cases.library:load_case",
        "open_run": "mpslab.analysis.results:open_run",
    },
)
