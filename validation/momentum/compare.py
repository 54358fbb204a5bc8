"""Momentum: forces between free particles, a drop that elongates, a square that spins."""

import numpy as np
from scipy.integrate import solve_ivp

from mpslab.core import plugins
from mpslab.core.neighbors import NeighborList
from mpslab.core.neighbourhood import Neighbourhood
from mpslab.core.particles import FLUID, make_particles
from mpslab.core.stencil import make_stencil
from validation.comparison import Comparison

GRADIENTS = ("corrected", "gc", "mps", "symmetric", "cmps")
BLOBS = 20
RADIUS = 2.1  # [spacings]
EARLY = 0.1  # of rate times time, at which the pressure in the square is read
MOMENT = 1.0  # of rate times time, at which the drop is held against theory
JUDGED = {"corrected": "", "symmetric": "_symmetric", "cmps": "_cmps"}  # endings of criteria
CHECKED = 0.0021  # m, the widest spacing whose drop is held against energy and momentum
OTHERS = ("mps", "paper")  # recipes beside `standard`


def compare(runs):
    """Forces of each gradient, and the ledgers of drop and square."""
    result = Comparison()
    _compare_forces(result)
    _compare_drop(result, {n: r for n, r in runs.items() if n != "square"})
    _compare_square(result, runs["square"])
    return result


def _compare_forces(result):
    rows = []
    for name in GRADIENTS:
        linear, angular = _forces(name)
        rows.append([name, linear, angular])
        if name in JUDGED:
            result.measure(f"linear{JUDGED[name]}", linear)
            result.measure(f"angular{JUDGED[name]}", angular)
    columns = ["gradient", "sum of forces / sum of their sizes", "the same of moments"]
    result.table(f"Pressure forces on a free blob of disordered water, rms of {BLOBS} blobs",
                 columns, rows)  # fmt: skip


def _forces(name):
    """Sum of the pressure forces over the sum of their sizes, and the same of their moments; the
    rms of all blobs, for a sum that is not zero by construction may be so in one of them.
    """
    sums = np.array([_blob(name, np.random.default_rng(seed)) for seed in range(BLOBS)])
    return np.sqrt(np.mean(sums**2, axis=0))


def _blob(name, random):
    """The two sums of one blob, disordered at random."""
    grid = np.stack(np.meshgrid(*[np.arange(16.0)] * 2), axis=-1).reshape(-1, 2)
    x = np.zeros((len(grid), 3))
    x[:, [0, 2]] = grid + random.uniform(-0.2, 0.2, grid.shape)
    x = x[np.linalg.norm(x - x.mean(axis=0), axis=1) < 7.0]
    particles = make_particles(x, np.full(len(x), FLUID, np.int8))
    pressure = random.uniform(0.0, 1.0, len(x))
    stencil, found = make_stencil(2, 1.0, RADIUS), NeighborList()
    found.build(particles.position, RADIUS, 0.0, particles.fluid)
    force, particles.pressure[:] = np.zeros((len(x), 3)), pressure
    near = Neighbourhood(stencil).measure(particles, found)
    plugins.load("gradients", name).gradient(near, force)
    arm = x - x.mean(axis=0)
    moment = np.cross(arm, force)[:, 1]
    sizes = np.linalg.norm(force, axis=1)
    linear = np.linalg.norm(force.sum(axis=0)) / sizes.sum()
    angular = abs(moment.sum()) / (np.linalg.norm(arm, axis=1) * sizes).sum()
    return linear, angular


def _compare_drop(result, runs):
    drops = {name: _Drop(run) for name, run in runs.items()}
    time = drops["drop-2mm"].time
    for axis, exact in zip(("long", "short"), _ellipse(time), strict=True):
        title = f"{axis.capitalize()} semi-axis of the drop"
        figure = result.figure(title, "rate x time", "semi-axis / radius at rest")
        for name, drop in drops.items():
            figure.line(runs[name].label, drop.time, getattr(drop, axis))
        figure.dashed("theory", time, exact)
    columns = ["run", "worst semi-axis [%]", "energy [%]", "linear momentum", "angular momentum"]
    result.table("Elongating drop at rate x time = 1 (momentum over sum of m |u|, m |r| |u|)",
                 columns, [[name, *drop.figures()] for name, drop in drops.items()])  # fmt: skip
    _judge_drop(result, {name: drop for name, drop in drops.items() if name not in OTHERS})


def _judge_drop(result, drops):
    """Criteria of the drops of `standard`, and the order of their semi-axes."""
    result.measure("drop", drops["drop-2mm"].error)
    if "drop-1mm" in drops:
        result.measure("drop_fine", drops["drop-1mm"].error)
    fine = [drop for drop in drops.values() if drop.spacing < CHECKED]
    result.measure("drop_energy", max((drop.gain for drop in fine), key=abs))
    result.measure("drop_momentum", max(drop.drift for drop in fine))
    spacings, errors = zip(*((drop.spacing, drop.error) for drop in drops.values()), strict=True)
    order = result.converge("Semi-axes of the drop, worst error [%]", spacings, errors)
    result.measure("drop_order", order)


class _Drop:
    """A drop that elongates: its semi-axes against time, and how it stands at rate x time = 1.

    Attributes
    ----------
    spacing : float [m]
    time, long, short : (n,) float64
        Rate times time, and the semi-axes over the radius.
    error, gain : float [%]
        Of the worse semi-axis, and of the energy.
    drift, turn : float
        Linear and angular momentum, over the sums of their sizes.

    NaN where the run ended before.
    """

    def __init__(self, run):
        body, self.spacing = _Body(run), run.spacing
        self.time = run.case.initial.rate * body.time
        self.long, self.short = body.axes()
        self.error = self.gain = self.drift = self.turn = np.nan
        if self.time[-1] >= MOMENT - 1e-3:
            at = np.argmin(np.abs(self.time - MOMENT))
            seen, exact = (self.long[at], self.short[at]), np.array(_ellipse(self.time))[:, at]
            self.error = 100.0 * np.abs(seen / exact - 1.0).max()
            self.gain = 100.0 * (body.energy[at] / body.energy[0] - 1.0)
            self.drift, self.turn = body.drift(at), body.turn(at)

    def figures(self):
        """Error, gain, drift and turn."""
        return self.error, self.gain, self.drift, self.turn


def _ellipse(time):
    """Semi-axes of a drop of radius 1 that elongates at the rate 1, no force: (n,) each.

    da/dt = s a, db/dt = -s b, ds/dt = s^2 (b^2 - a^2)/(a^2 + b^2).
    """

    def rates(_, state):
        s, a, b = state
        return s**2 * (b**2 - a**2) / (a**2 + b**2), s * a, -s * b

    found = solve_ivp(rates, (0.0, time[-1]), (1.0, 1.0, 1.0), t_eval=time, rtol=1e-9, atol=1e-12)
    return found.y[1], found.y[2]


def _compare_square(result, run):
    rate, body = run.case.initial.rate, _Body(run)
    time = rate * body.time
    figure = result.figure("Square that spins", "rate x time", "of the start")
    figure.line("kinetic energy", time, body.energy / body.energy[0])
    turn = np.array([body.spin(k) for k in range(len(time))])
    figure.line("angular momentum", time, turn / turn[0])
    result.measure("square_pressure", _pressure(run) / _tension(run))
    result.measure("square_energy", 100.0 * (body.energy[-1] / body.energy[0] - 1.0))
    result.measure("square_spin", 100.0 * (turn[-1] / turn[0] - 1.0))
    for share in (0.5, 1.0):
        k = round(share * (len(time) - 1))
        shape = result.figure(
            f"Square at rate x time = {time[k]:.2g}", "x [m]", "z [m]", equal=True
        )
        shape.points("water", body.x[k][:, 0], body.x[k][:, 2])


def _pressure(run):
    """Mean pressure of the water in the middle tenth of the square, at rate x time = 0.1 [Pa]."""
    frame = run.frames.at(EARLY / run.case.initial.rate)
    wet, x = frame["kind"] == FLUID, frame["position"]
    near = np.linalg.norm(x - x[wet].mean(axis=0), axis=1) < 0.1 * _side(run)
    return frame["pressure"][wet & near].mean()


def _side(run):
    (box,) = run.case.water
    return box.end[0] - box.start[0]


def _tension(run):
    """Pressure in the middle of a square that begins to spin [Pa] (Colagrossi 2005).

    p = -sum 32 rho A^2 / (m n pi^2) / [(m pi/l)^2 + (n pi/l)^2] sin(m pi/2) sin(n pi/2), m, n odd.
    """
    m = np.arange(1, 200, 2)
    signs = np.sin(0.5 * np.pi * m) / m
    waves = (m[:, None] ** 2 + m[None, :] ** 2) * (np.pi / _side(run)) ** 2
    total = np.sum(signs[:, None] * signs[None, :] / waves)
    return -32.0 * run.density * run.case.initial.rate**2 / np.pi**2 * total


class _Body:
    """A free body of water, frame by frame."""

    def __init__(self, run):
        frames = list(run.water())
        self.time = np.array([time for time, _, _ in frames])
        self.x = [x - x.mean(axis=0) for _, x, _ in frames]
        self.u = [u for _, _, u in frames]
        self.energy = np.array([np.sum(u**2) for u in self.u])

    def axes(self):
        """Semi-axes along x and z over the radius of the start, from the second moments."""
        moments = np.array([np.sqrt(np.mean(x**2, axis=0)) for x in self.x])
        return moments[:, 0] / moments[0, 0], moments[:, 2] / moments[0, 2]

    def drift(self, k):
        """Sum of u over the sum of |u| in a frame."""
        return np.linalg.norm(self.u[k].sum(axis=0)) / np.linalg.norm(self.u[k], axis=1).sum()

    def spin(self, k):
        """Sum of r x u in a frame, about the centre."""
        return np.cross(self.x[k], self.u[k])[:, 1].sum()

    def turn(self, k):
        """The same over the sum of |r| |u|."""
        sizes = np.linalg.norm(self.x[k], axis=1) * np.linalg.norm(self.u[k], axis=1)
        return abs(self.spin(k)) / sizes.sum()
