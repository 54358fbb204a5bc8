"""Fully nonlinear potential flow in a flat tank with a piston: what waves an ideal tank has.

Zakharov's equations for the level and the potential at the surface, in coordinates that follow the
piston, x = X + (L - X) xi, and the surface, z = (h + eta) sigma; Laplace's equation in them by
finite differences (Bingham & Zhang 2007, J. Eng. Math. 58): of fourth order along xi, over all of
Chebyshev's nodes along sigma. GMRES solves it; its preconditioner is the tank at rest, which is
factored once.
"""

from functools import cache

import numpy as np
from scipy import sparse
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import LinearOperator, gmres, splu

from mpslab.core import plugins
from mpslab.theory import waves
from validation.potential_flow import runge_kutta

LAYERS = 9  # nodes over the depth
COLUMNS = 120  # intervals to a wavelength of the peak
STEPS = 80  # to a period of the peak
ACROSS = 5  # nodes of a difference along the tank
SMOOTHED = 0.2  # share of what alternates from node to node that a step takes away
STRENGTH = 1.0  # of the sponge, in angular frequencies of the peak
ACCURATE = 1e-6
MOST = 50  # iterations of a solve; it takes some five


def levels(case, places, period=None):
    """What the piston of a case would make in fully nonlinear potential flow.

    The piston moves as its theory has it: it does not absorb. A sponge up to the far end swallows
    what comes there.

    Parameters
    ----------
    case : mpslab.core.parameters.Case
        A flat tank with a wavemaker.
    places : (g,) float [m]
    period : float, optional [s]
        Of the peak, which sets nodes and steps; left out, that of the wavemaker.

    Returns
    -------
    time : (n,) float64 [s]
        From 0 to the end of the case, 80 times to a period.
    level : (n, g) float64 [m]
        Above still water.

    Raises
    ------
    ArithmeticError
        If a wave breaks, which there is no solution for.
    """
    return _levels(
        case.tank, case.fluid.gravity, case.wavemaker, case.sponge, case.time.end, tuple(places),
        period or case.wavemaker.period,
    )  # fmt: skip


@cache  # the draws of a run have the same piston
def _levels(basin, gravity, wavemaker, sponges, end, places, period):
    k = waves.wave_number(period, basin.depth, gravity)
    columns = int(np.ceil(COLUMNS * basin.length * k / (2.0 * np.pi)))
    step = period / STEPS
    times = step * np.arange(int(np.ceil(end / step)) + 1)
    fine = 0.25 * step * np.arange(4 * len(times))
    maker = plugins.load("wavemakers", wavemaker.type)
    paddle = maker.make(wavemaker, basin.depth, gravity, end)
    motion = CubicSpline(fine, [paddle.displacement(time) for time in fine])
    tank = Tank(basin.length, basin.depth, gravity, columns, motion)
    for sponge in sponges:
        tank.swallow(sponge.start, STRENGTH * 2.0 * np.pi / period)
    found = np.zeros((len(times), len(places)))
    for n, time in enumerate(times):
        found[n] = CubicSpline(tank.x(time), tank.level)(places)
        tank.advance(time, step)
    return times, found


def solitary_period(height, depth, gravity):
    """What stands for the period [s] of a solitary wave: in it there is all of the wave but 1 %."""
    length = 2.0 * np.pi / waves.solitary_wave_number(height, depth)
    return length / waves.solitary_celerity(height, depth, gravity)


class Tank:
    """A flat tank, at rest at the start, between a piston at x = 0 and a wall.

    Parameters
    ----------
    length, depth, gravity : float [m], [m], [m/s2]
    columns : int
        Intervals along the tank.
    motion : function (t [s], derivative = 0) -> float [m], [m/s]
        Displacement and speed of the piston.

    Attributes
    ----------
    level : (columns + 1,) float64 [m]
        Of the surface above still water.
    potential : (columns + 1,) float64 [m2/s]
        At the surface.
    """

    def __init__(self, length, depth, gravity, columns, motion):
        self.length, self.depth, self.gravity, self.motion = length, depth, gravity, motion
        self.xi = np.linspace(0.0, 1.0, columns + 1)
        self.sigma = 0.5 - 0.5 * np.cos(np.pi * np.arange(LAYERS) / (LAYERS - 1))
        self.level, self.potential = np.zeros_like(self.xi), np.zeros_like(self.xi)
        self.damping = np.zeros_like(self.xi)
        self.along, curved = _differences(self.xi, ACROSS)
        up, bent = _differences(self.sigma, LAYERS)
        self.up, self.bent = up.toarray(), bent.toarray()
        self.flow = np.zeros((columns + 1, LAYERS))
        self.at_rest = splu(self._at_rest(curved, up, bent))

    def swallow(self, start, rate):
        """Let level and potential die out from x = start [m] on, at a rate [1/s] that grows."""
        x = self.length * self.xi
        self.damping = rate * np.clip((x - start) / (self.length - start), 0.0, 1.0) ** 2

    def x(self, time):
        """Where the nodes are, (columns + 1,) [m]."""
        face = float(self.motion(time))
        return face + (self.length - face) * self.xi

    def advance(self, time, step):
        """Take the water from time to time + step [s], by Runge & Kutta's method."""
        state = np.array([self.level, self.potential])
        self.level, self.potential = _smoothed(runge_kutta(self._rates, time, state, step))

    def _rates(self, time, state):
        """Rates of level and potential at the nodes, which move with the piston, (2, n)."""
        level, potential = state
        face, speed = float(self.motion(time)), float(self.motion(time, 1))
        slope, drift = self._along(state.T, face).T
        w = self._rising(level, potential, face, speed)
        steep, carried = 1.0 + slope**2, speed * (1.0 - self.xi)
        return np.array([
            w * steep - slope * drift + carried * slope,
            -self.gravity * level - 0.5 * drift**2 + 0.5 * w**2 * steep + carried * drift,
        ]) - self.damping * state  # fmt: skip

    def _along(self, values, face):
        return self.along @ values / (self.length - face)

    def _rising(self, level, potential, face, speed):
        """Vertical velocity of the water at the surface, (n,) [m/s]."""
        height = self.depth + level
        stretched = -np.outer(self._along(level, face) / height, self.sigma)
        narrow = (height**-2.0)[:, np.newaxis]

        def horizontal(values):
            return self._along(values, face) + stretched * (values @ self.up.T)

        def equation(values):
            values = values.reshape(self.flow.shape)
            u = horizontal(values)
            found = horizontal(u) + narrow * (values @ self.bent.T)
            found[:, 0] = values @ self.up[0]
            found[[0, -1]] = u[[0, -1]]
            found[:, -1] = values[:, -1]
            return found

        def nearly(found):
            return self.at_rest.solve(found.ravel())

        wanted = np.zeros_like(self.flow)
        wanted[0] = speed
        wanted[:, -1] = potential
        size = self.flow.size
        operator = LinearOperator((size, size), lambda values: nearly(equation(values)))
        enough = ACCURATE * np.linalg.norm(nearly(wanted))
        off = nearly(wanted - equation(self.flow))
        missing, failed = gmres(operator, off, rtol=0.0, atol=enough, restart=MOST, maxiter=1)
        if failed:
            raise ArithmeticError(
                f"potential flow in the tank: no solution in {MOST} iterations; is a wave breaking?"
            )
        self.flow += missing.reshape(self.flow.shape)
        return self.flow @ self.up[-1] / height

    def _at_rest(self, curved, up, bent):
        """The equation for the tank at rest, a sparse matrix."""
        columns, rows = sparse.identity(len(self.xi)), sparse.identity(LAYERS)
        kind = np.zeros(self.flow.shape, int)
        kind[:, 0], kind[[0, -1]], kind[:, -1] = 1, 2, 3
        laplacian = sparse.kron(curved / self.length**2, rows)
        laplacian += sparse.kron(columns, bent / self.depth**2)
        beds, ends = sparse.kron(columns, up), sparse.kron(self.along / self.length, rows)
        parts = laplacian, beds, ends, sparse.identity(kind.size)
        return sum(
            sparse.diags((kind.ravel() == n).astype(float)) @ part for n, part in enumerate(parts)
        ).tocsc()


def _differences(nodes, across):
    """First and second derivative at all nodes, each from the `across` nodes around, sparse."""
    count = len(nodes)
    first, second = sparse.lil_matrix((count, count)), sparse.lil_matrix((count, count))
    for row, node in enumerate(nodes):
        begin = min(max(row - across // 2, 0), count - across)
        around = slice(begin, begin + across)
        powers = np.vander(nodes[around] - node, increasing=True).T
        wanted = np.zeros((across, 2))
        wanted[1, 0], wanted[2, 1] = 1.0, 2.0
        first[row, around], second[row, around] = np.linalg.solve(powers, wanted).T
    return first.tocsr(), second.tocsr()


def _smoothed(state):
    """Values (2, n) less a share of what alternates from node to node, by an eighth difference."""
    difference = np.zeros_like(state)
    difference[:, 4:-4] = np.diff(state, 8) / 256.0
    return state - SMOOTHED * difference
