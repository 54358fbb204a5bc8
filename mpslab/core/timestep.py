"""Choice of the time step: the least of several limits, each with a name.

Where water runs into a wall, or into other water, the blow takes as long as the gap takes to close.
If that is only a few long steps, the pressure is so high that the disorder of the particles throws
them about, and the water gains energy. The rate at which water runs together tells of the blow in
time, some steps before.
"""

from math import hypot, sqrt

# Shares of the time that a wave, or the fastest water, takes for a spacing.
LARGEST = {"start": 0.4, "predicted": 0.1}
WEIGHTLESS = {"start": 0.2, "predicted": 0.1}  # LARGEST where nothing weighs
COURANT = {"start": 0.5, "predicted": 0.2}
PACE = 0.2


def limits(case, previous, max_speed, compression=0.0):
    """Limits of the next time step by name [s].

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    previous : float [s]
        Last time step, 0 before the first.
    max_speed : float [m/s]
        Of water that has neighbours, piston and gates.
    compression : float [1/s]
        Largest rate at which water ran together in the last step, before the pressure acted.
    """
    time, spacing = case.time, case.particles.spacing
    found = {"maximum": time.maximum}
    if max_speed > 0.0:
        found["courant"] = time.courant * spacing / max_speed
    if compression > 0.0 and case.scheme.projection == "start":
        found["compression"] = time.compression / compression
    if case.fluid.viscosity > 0.0:
        found["viscous"] = time.viscous * spacing**2 / case.fluid.viscosity
    if previous > 0.0:
        found["growth"] = time.growth * previous
    else:
        found["start"] = time.start
    return found


def choose(case, previous, max_speed, compression=0.0):
    """The least limit: (dt [s], its name)."""
    found = limits(case, previous, max_speed, compression)
    name = min(found, key=found.get)
    return float(found[name]), name


def largest(case, gravity):
    """Largest time step where none is given [s]; 0 where nothing moves.

    0.4 d0 / sqrt(g h) with the largest depth h, without gravity 0.2 d0 / speed at the start; 0.1 in
    both where the pressure acts at predicted positions, which damps waves by the step.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
    gravity : float [m/s2]
        The strongest that acts on the water: that of the case and the inertia in a moving tank.
    """
    speed, spacing = wave_speed(case, gravity), case.particles.spacing
    if speed == 0.0:
        return 0.0
    shares = LARGEST if gravity > 0.0 else WEIGHTLESS
    return shares[case.scheme.projection] * spacing / speed


def pace(case):
    """Time in which the shares of the scheme count, whatever the step [s].

    A fifth of that in which a wave goes one spacing, 0.2 d0 / sqrt(g h); the largest step where
    nothing moves and nothing weighs.
    """
    speed = wave_speed(case, case.fluid.gravity)
    return PACE * case.particles.spacing / speed if speed > 0.0 else case.time.maximum


def share(strength, dt, pace):
    """What a step dt [s] takes back of what is to lose a share `strength` in each pace [s]."""
    return 1.0 - (1.0 - strength) ** (dt / pace)


def wave_speed(case, gravity):
    """sqrt(g h) with the largest depth; without gravity the largest speed at the start [m/s]."""
    return sqrt(gravity) * sqrt(case.tank.deepest) or initial_speed(case)


def initial_speed(case):
    """Speed of a stream, or the one that `initial.rate` gives a corner of the water [m/s].

    0 where the water has neither.
    """
    if case.initial.type == "stream":
        return abs(case.initial.speed)
    if case.initial.type not in ("strain", "rotation"):
        return 0.0
    tank = case.tank
    boxes = [(box.start, box.end) for box in case.water] or [
        ((0.0, 0.0, 0.0), (tank.length, tank.width, tank.depth))
    ]
    along, up = (
        max(end[k] for _, end in boxes) - min(start[k] for start, _ in boxes) for k in (0, 2)
    )
    return 0.5 * abs(case.initial.rate) * hypot(along, up)
