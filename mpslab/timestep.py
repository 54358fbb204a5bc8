"""Choice of the time step: the least of several limits, each with a name."""


def limits(case, previous, max_speed):
    """Limits of the next time step by name [s].

    Parameters
    ----------
    case : mpslab.parameters.Case
    previous : float [s]
        Last time step, 0 before the first.
    max_speed : float [m/s]
        Of water, piston and gates.
    """
    time, spacing = case.time, case.particles.spacing
    found = {"maximum": time.maximum}
    if max_speed > 0.0:
        found["courant"] = time.courant * spacing / max_speed
    if case.fluid.viscosity > 0.0:
        found["viscous"] = time.viscous * spacing**2 / case.fluid.viscosity
    if previous > 0.0:
        found["growth"] = time.growth * previous
    else:
        found["start"] = time.start
    return found


def choose(case, previous, max_speed):
    """The least limit: (dt [s], its name)."""
    found = limits(case, previous, max_speed)
    name = min(found, key=found.get)
    return float(found[name]), name
