"""Water in a rectangular tank that moves, by linear potential flow: small waves, no friction."""

import numpy as np

from mpslab.theory.waves import standing_wave_frequency

MODES = (1, 3, 5, 7, 9)  # of the surface; the even ones stay at rest


def rise(times, sway, angle, spin, length, depth, above, gravity):
    """Elevation of the surface at the wall x = 0 [m], (n,); at x = length it is the opposite.

    The surface is sum b_n cos(k_n x), k_n = n pi/l. From rest at t = 0, for odd n,

        b_n'' + w_n^2 b_n = (4 tanh(k_n h)/(l k_n)) [X'' + g a + a'' (z_c + (2/k_n) tanh(k_n h/2))]

    with the displacement X of the tank along x, and its angle a about an axis z_c above the still
    level (Faltinsen 1978, J. Ship Research 22, 224; `validation/sloshing` says more).

    Parameters
    ----------
    times : (n,) float64 [s]
        From 0 on, evenly; fine enough for the last of MODES.
    sway, angle, spin : (n,) float64 [m/s2], [rad], [rad/s2]
        X'', a and a''.
    length, depth, above, gravity : float [m], [m], [m], [m/s2]
        Of the tank and its still water, z_c, and gravity.
    """
    total = np.zeros(len(times))
    for mode in MODES:
        k = mode * np.pi / length
        arm = above + 2.0 / k * np.tanh(0.5 * k * depth)
        push = 4.0 * np.tanh(k * depth) / (length * k) * (sway + gravity * angle + arm * spin)
        total += _from_rest(times, push, standing_wave_frequency(mode, length, depth, gravity))
    return total


def _from_rest(times, push, frequency):
    """Solution of b'' + w^2 b = push with b = b' = 0 at first, by Duhamel's integral, (n,)."""
    cosine, sine = np.cos(frequency * times), np.sin(frequency * times)
    along, across = (_integral(push * wave, times[1] - times[0]) for wave in (cosine, sine))
    return (sine * along - cosine * across) / frequency


def _integral(values, step):
    """Integral from the first of the values to each, by the trapezoidal rule, (n,)."""
    return step * np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1])))
