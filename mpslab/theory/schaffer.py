"""Second-order wavemaker theory of a piston for any pair of waves (Schaffer 1996).

Two waves n, m carry bound waves at the sum and the difference of their frequencies. A piston that
moves by first-order theory sends free waves of the same frequencies and of about the same size with
them; the motion given here is what it must do in addition so that it does not.

The surface is the real part of A e^{i (omega t - k x)}. A difference is a sum in which wave m is
replaced by its complex conjugate: omega -> -omega, k -> -k*, A -> A*. So one formula serves both.
"""

import numpy as np
import scipy

from mpslab.theory.dispersion import LARGEST_KH, biesel, evanescent, wave_numbers

MODES = 24  # waves near the piston that are taken into account
SAME = 1e-9  # share in which the squares of two wave numbers differ that count as one
NODES = 32  # frequencies at which the functions are worked out, to each side of a table


def transfer(first, second, sign, depth, gravity, modes=MODES):
    """Motion of the piston at the sum or difference of two frequencies.

    Parameters
    ----------
    first, second : (n,) float64 [rad/s]
        Frequencies; the first is the larger for a difference. Where both are equal, the sum is that
        of a wave with itself.
    sign : 1 or -1
        Sum or difference.
    depth, gravity : float [m], [m/s2]
    modes : int
        Waves near the piston that count. What the others would add falls with 1 / modes, so it is
        taken as the difference to half of them.

    Returns
    -------
    (n,) complex128 [1/m]
        Complex amplitude of X over A_n A_m, or over A_n A_m* for a difference.
    """
    u = _Wave(first, depth, gravity, modes)
    v = _Wave(second, depth, gravity, modes)
    v = v if sign > 0 else v.conjugate()
    rate = u.rate + v.rate
    number = wave_numbers(rate, depth, gravity)  # of the free wave that must not be
    bound = 2.0 * _bound(u, v, number, modes) - _bound(u, v, number, modes // 2)
    wall = 0.5 * (
        u.piston * v.curvature(number, rate, gravity)
        + v.piston * u.curvature(number, rate, gravity)
    )
    return _once(u, v) * gravity * number**2 / rate**3 * (-bound / gravity + 1j * wall)


def _bound(u, v, number, modes):
    """What the bound waves of all modes bring to the free wave at the piston."""
    return sum(
        (k + other) / ((k + other) ** 2 - number**2) * p * q * _surface(u, k, v, other)
        for k, p in zip(u.k[: modes + 1], u.p, strict=False)
        for other, q in zip(v.k[: modes + 1], v.p, strict=False)
    )


def bound_wave(first, second, sign, depth, gravity):
    """Bound wave of two progressive waves: its complex amplitude over A_n A_m(*), (n,) [1/m].

    As for `transfer`; far from the piston, where no other waves are.
    """
    u = _Wave(first, depth, gravity, 0)
    v = _Wave(second, depth, gravity, 0)
    v = v if sign > 0 else v.conjugate()
    rate, k, unit = u.rate + v.rate, u.k[0] + v.k[0], u.p[0] * v.p[0]
    potential = _surface(u, u.k[0], v, v.k[0]) / (gravity * k * np.tanh(k * depth) - rate**2)
    speeds = 0.5 * (u.q * v.q - u.k[0] * v.k[0])
    rise = 0.5 * u.rate * v.rate / gravity * (u.q + v.q)
    return _once(u, v) * unit * (-1j * rate * potential - speeds - rise) / gravity


def _once(u, v):
    """Factor 1/2 where both waves are the same one: this pair comes once, not twice."""
    return np.where(u.rate == v.rate, 0.5, 1.0)


def _surface(u, k, v, other):
    """What drives the second order at the surface, of unit potentials with these wave numbers."""
    both = (u.rate + v.rate) * (k * other - u.q * v.q)
    each = u.rate * (other**2 - v.q**2) + v.rate * (k**2 - u.q**2)
    return 1j * (both + 0.5 * each)


class _Wave:
    """A wave of unit amplitude with what stays near its piston.

    Attributes: rate [rad/s], q = omega^2 / g [1/m], the piston's complex amplitude [-], steepness
    dq / d(k^2) [m]; by mode, the progressive one first, the wave numbers k [1/m] and the potentials
    p at the surface.
    """

    def __init__(self, rate, depth, gravity, modes):
        self.rate = np.asarray(rate, float)
        self.q = self.rate**2 / gravity
        number = wave_numbers(self.rate, depth, gravity)
        near = evanescent(self.rate, depth, gravity, modes)
        ratio = biesel(number * depth)
        shares = -4j * np.sin(near) ** 2 / (np.sin(2.0 * near) + 2.0 * near)
        self.piston = -1j / ratio
        kh = np.minimum(number * depth, LARGEST_KH)
        self.steepness = (np.tanh(kh) + kh / np.cosh(kh) ** 2) / (2.0 * number)
        self.k = [number.astype(complex), *(-1j * near / depth)]
        self.p = [1j * gravity / self.rate * share for share in (1.0 + 0j, *(shares / ratio))]

    def conjugate(self):
        """The same wave in terms of e^{-i omega t}."""
        other = object.__new__(_Wave)
        other.rate, other.q, other.piston = -self.rate, self.q, self.piston.conj()
        other.steepness = self.steepness
        other.k = [-k.conj() for k in self.k]
        other.p = [p.conj() for p in self.p]
        return other

    def curvature(self, number, rate, gravity):
        """What the change of velocity along x makes at a piston that is off its place."""
        lack, found = self.q - rate**2 / gravity, 0.0
        for k, p in zip(self.k, self.p, strict=True):
            apart = k**2 - number**2
            same = np.abs(apart) < SAME * number**2
            slope = lack / np.where(same, 1.0, apart)
            found = found + k**2 * p * np.where(same, self.steepness, slope)
        return found


def motion(amplitude, first, step, depth, gravity, lowest=0.0):
    """Second-order motion of the piston for all pairs of a sea.

    Parameters
    ----------
    amplitude : (n,) complex128 [m]
        Of the waves, whose frequencies are (first + i) step.
    first : int
        Number of the first of them.
    step : float [rad/s]
    depth, gravity : float [m], [m/s2]
    lowest : float [rad/s]
        Differences below are left out.

    Returns
    -------
    (2 (first + n) - 1,) complex128 [m]
        Complex amplitudes of X at all multiples of the step.
    """

    def pair(one, other, sign):
        return transfer(one, other, sign, depth, gravity)

    return of_pairs(amplitude, first, step, pair, lowest)


def of_pairs(amplitude, first, step, pair, lowest=0.0):
    """Sum over all pairs of a sea of what is proportional to A_n A_m, or A_n A_m*.

    Parameters
    ----------
    amplitude, first, step, lowest
        As for `motion`.
    pair : function (first, second, sign) -> (n,) complex128
        As `transfer`.

    Returns
    -------
    (2 (first + n) - 1,) complex128
        Complex amplitudes at all multiples of the step.
    """
    count = len(amplitude)
    rate = (first + np.arange(count)) * step
    found = np.zeros(2 * (first + count) - 1, complex)
    sums, differences = _tables(rate, pair)
    least = max(int(np.ceil(lowest / step)), 1)
    for i in range(count):
        n = first + i
        pairs = amplitude[i] * amplitude[: i + 1] * sums(rate[i], rate[: i + 1])
        pairs[i] *= 0.5
        found[n + first : 2 * n + 1] += pairs
        last = i + 1 - least
        if last > 0:
            gap = rate[i] - rate[:last]
            pairs = amplitude[i] * amplitude[:last].conj() * differences(rate[i], rate[:last]) / gap
            found[least : i + 1] += pairs[::-1]
    return found


def _tables(rate, pair):
    """Functions of two frequencies: `pair` of the sum, and of the difference times that.

    Both are smooth, so that splines between a few frequencies stand for all pairs, to 1e-4; only in
    deep water, where what is near the piston meets a free wave (one frequency twice the other), to
    some per cent. On the diagonal the sum counts both waves, and the difference is taken beside it.
    """
    low, high = rate[0], max(rate[-1], rate[0] * 1.01)
    nodes = np.linspace(low, high, NODES)
    u, v = (part.ravel() for part in np.meshgrid(nodes, nodes, indexing="ij"))
    # A wave must not meet itself here: the two frequencies lie a little to either side.
    apart = np.where(u == v, 1e-4, 0.0) * nodes[0]
    larger, smaller = np.maximum(u, v) + apart, np.minimum(u, v) - apart
    tables = []
    for sign in (1, -1):
        values = pair(larger, smaller, sign)
        if sign < 0:
            values = values * (larger - smaller)
            values = np.where(u < v, -values.conj(), values)  # with a negative difference
        values = values.reshape(NODES, NODES)
        tables.append([scipy.interpolate.RectBivariateSpline(nodes, nodes, part, kx=5, ky=5)
                       for part in (values.real, values.imag)])  # fmt: skip

    def between(table):
        return lambda one, many: (table[0](one, many) + 1j * table[1](one, many))[0]

    return [between(table) for table in tables]
