"""The decay of a wave in a viscous liquid against linear theory."""

import numpy as np
from scipy.optimize import least_squares, newton

from mpslab.theory.waves import standing_wave_frequency
from validation.comparison import Comparison
from validation.wave_analysis import modes


def compare(runs):
    """Rate of decay of the first mode of the surface."""
    result = Comparison()
    figure = result.figure("First mode of the surface", "t [s]", "first mode / amplitude")
    rows = {}
    for name, run in runs.items():
        tank, amplitude = run.case.tank, run.case.initial.amplitude
        exact = growth(tank.length, run.depth, run.gravity, run.case.fluid.viscosity)
        time, mode = modes(run, 1)
        decay, frequency = fitted(time, mode / amplitude, exact)
        rows[name] = [decay, -exact.real, frequency, exact.imag]
        figure.line(run.label, time, mode / amplitude)
    figure.dashed("linear theory", time, np.exp(exact.real * time) * np.sin(exact.imag * time))
    result.measure("decay", rows["wave-1mm"][0] / rows["wave-1mm"][1])
    columns = ["run", "decay [1/s]", "theory", "frequency [1/s]", "theory"]
    result.table("Decay and frequency", columns, [[name, *row] for name, row in rows.items()])
    return result


def growth(length, depth, gravity, viscosity):
    """n [1/s] of a first standing wave exp(n t) whose surface and bed have no stress, complex.

    README.md has the equation.
    """
    k = np.pi / length
    tanh, inviscid = np.tanh(k * depth), standing_wave_frequency(1, length, depth, gravity)

    def equation(n):
        m = np.sqrt(k * k + n / viscosity + 0j)
        both = m * m + k * k
        layer = 4.0 * viscosity * k**3 * m * n * tanh / (both * np.tanh(m * depth))
        return n * (n + 2 * viscosity * k * k) - layer + inviscid**2 * (1 - 2 * k * k / both)

    return newton(equation, 1j * inviscid - 2.0 * viscosity * k * k, tol=1e-12)


def fitted(time, mode, exact):
    """Decay and frequency [1/s] of the cosine that is fitted to a mode."""

    def rest(p):
        return p[0] * np.exp(-p[1] * time) * np.cos(p[2] * time + p[3]) + p[4] - mode

    starts = [[1.0, -exact.real, exact.imag, phase, 0.0] for phase in (-1.5, 0.0, 1.5)]
    best = min((least_squares(rest, start) for start in starts), key=lambda found: found.cost)
    return best.x[1], best.x[2]
