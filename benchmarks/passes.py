"""``python -m benchmarks.passes``: the loops over pairs of a step, on the paper's tank in 3-D.

Each pass and its plain form (the formula in numpy, over the same pairs, in double precision) run in
turn in one process.  Printed are the medians in ns of the processor a pair, the ratio of both, the
largest difference of their results over the largest value, and the share of its roofline: the time
that a copy of as many bytes takes, measured in the same run, over the time of the pass.
"""

import argparse
import time
from functools import cached_property

import numpy as np

from mpslab import Simulation, load_case
from mpslab.models import friction, hyperviscosity
from mpslab.pressure import equation
from mpslab.run import step

COPY = 2**24  # doubles, 128 MB: more than any cache
# What a pass has to read and write, a pair and a particle.
BYTES = {
    "measure": (24, 273),
    "viscosity": (24, 88),
    "adjoint": (20, 152),
    "gradient": (20, 168),
    "matrix": (16, 24),
}
# Those that have no plain form.
ALONE = {
    "hyperviscosity": (48, 248),
    "product": (8, 28),
    "search": (4, 28),  # the last: what it finds has not been measured
}


def settled(spacing, warm=2):
    """Flow of the plunging breaker after some steps, its pairs measured."""
    run = Simulation(load_case("plunging_breaker", {"particles.spacing": spacing,
                                                    "scheme.settling": 15}))  # fmt: skip
    for _ in range(warm):
        run.advance()
    flow = run._flow
    flow.particles, _ = flow.domain.share_out(flow.particles)
    step.find_neighbors(flow)
    step.measure(flow)
    step.find_surface(flow)
    return flow


class Plain:
    """The formulas over pairs i, j in numpy."""

    def __init__(self, flow):
        self.flow, self.near = flow, flow.near
        self.i = np.repeat(np.arange(len(flow.particles)), np.diff(self.near.row))
        self.j, self.water = self.near.other.copy(), flow.particles.fluid

    def sum(self, values):
        """Sums (n,) of the values (m,) of pairs."""
        return np.bincount(self.i, values, len(self.water))

    def geometry(self):
        """r_ij (m, 3), to solids as the water sees them, w/r^2 (m,) and r (m,)."""
        x, width = self.flow.particles.position, self.flow.stencil.width
        r = x[self.j] - x[self.i]
        if width:
            r[:, 1] -= width * np.rint(r[:, 1] / width)
        square = np.einsum("ka,ka->k", r, r)
        solid = np.flatnonzero(~self.water[self.j])
        r[solid] += self.near.offset[solid, :3] - self.near.straight[solid, :3]
        far = np.sqrt(square)
        return r, np.maximum(self.flow.stencil.radius / far - 1.0, 0.0) / square, far

    def measure(self):
        r, g, far = self.geometry()
        second = [self.sum(g * r[:, a] * r[:, b]) for a in range(3) for b in range(a, 3)]
        return np.stack([*second, self.sum(g * far**2)], axis=1)

    def viscosity(self):
        r, g, _ = self.geometry()
        u, stencil, i, j = self.flow.particles.velocity, self.flow.stencil, self.i, self.j
        w = g * np.einsum("ka,ka->k", u[j] - u[i], r) * self.water[j]
        nu, moment = self.flow.case.fluid.viscosity, stencil.lambda0 * stencil.n0
        factor = 2.0 * nu * stencil.dim * (stencil.dim + 2) / moment
        return factor * np.stack([self.sum(w * r[:, a]) for a in range(3)], axis=1)

    def adjoint(self):
        r, g, _ = self.geometry()
        c, u, i, j = self.near.correction[:, :, :3], self.flow.particles.velocity, self.i, self.j
        d = np.where(self.water[j, None, None], c[j], c[i])
        return self.sum(g * np.einsum("ka,kab,kb->k", u[j] - u[i], d, r))

    def gradient(self):
        r, g, _ = self.geometry()
        c, p, i, j = self.near.correction[:, :, :3], self.flow.particles.pressure, self.i, self.j
        d = np.where(self.water[j, None, None], c[j], c[i])
        both = p[i, None, None] * d + p[j, None, None] * c[i]
        force = np.einsum("k,kab,kb->ka", g, both, r) * self.flow.stencil.dim / self.flow.stencil.n0
        return np.stack([self.sum(force[:, a]) for a in range(3)], axis=1)

    def matrix(self):
        _, g, far = self.geometry()
        one, first, third = self.flow.pair_terms
        value = (one + first / far + third / far**3) * (g > 0.0) * self.water[self.j]
        return self.sum(value)[self.water] / self.flow.case.fluid.density


class Passes:
    """The same as passes."""

    def __init__(self, flow):
        self.flow, self.near = flow, flow.near

    def measure(self):
        step.measure(self.flow)
        s = self.near.second
        parts = [s[:, 0, 0], s[:, 0, 1], s[:, 0, 2], s[:, 1, 1], s[:, 1, 2], s[:, 2, 2]]
        return np.stack([*parts, self.near.number_density], axis=1)

    def viscosity(self):
        flow, scheme = self.flow, self.flow.case.scheme
        seen = friction.velocity_seen(self.near, scheme, id)
        eddy = friction.eddies(self.near, seen, scheme, id)
        return friction.acceleration(
            self.near, flow.laplacian_stencil, seen, eddy, flow.case.fluid, scheme
        )

    def adjoint(self):
        return self.near.adjoint_divergence(self.flow.particles.velocity)

    def gradient(self):
        out = np.empty_like(self.flow.particles.velocity)
        self.flow.gradient.gradient(self.near, out)
        return out

    def matrix(self):
        return self._system().diagonal

    def _system(self):
        flow, n = self.flow, len(self.flow.particles)
        none = np.full(n, 1e-9)  # so that all rows are tied to the surface
        return equation.assemble(
            self.near, flow.laplacian_stencil, flow.pair_terms, flow.case.fluid.density,
            np.zeros(n), flow.particles.fluid, none,
        )[0]  # fmt: skip

    def search(self):
        step.find_neighbors(self.flow)

    def hyperviscosity(self):
        hyperviscosity.change(self.near, self.flow.particles.velocity, 0.3, id)

    @cached_property
    def product(self):
        system = self._system()
        x = np.ones(len(system))
        return lambda: system.multiply(x, np.empty_like(x))


def bandwidth(turns):
    """Bytes a second that a copy reads and writes, median."""
    source, target = np.zeros(COPY), np.zeros(COPY)
    return 2 * source.nbytes / np.median([_seconds(lambda: np.copyto(target, source))[0]
                                          for _ in range(turns)])  # fmt: skip


def compare(flow, turns):
    """Rows of the table: name, ns a pair of pass and plain form, difference, share of roofline."""
    passes, plain = Passes(flow), Plain(flow)
    speed, pairs, rows = bandwidth(turns), len(flow.near.other), []
    for name, (pair, particle) in BYTES.items():
        spent, results = {}, {}
        for _ in range(turns):
            for form in (passes, plain):
                seconds, results[form] = _seconds(getattr(form, name))
                spent.setdefault(form, []).append(seconds)
        fast, slow = (np.median(spent[form]) for form in (passes, plain))
        off = np.abs(results[passes] - results[plain]).max() / np.abs(results[plain]).max()
        roof = (pair * pairs + particle * len(flow.particles)) / speed
        rows.append((name, 1e9 * fast / pairs, 1e9 * slow / pairs, off, roof / fast))
    return rows


def alone(flow, turns):
    """Name, ns a pair, and ns a pair of the roofline, of each pass."""
    passes, speed, pairs = Passes(flow), bandwidth(turns), len(flow.near.other)
    rows = []
    for name, (pair, particle) in (BYTES | ALONE).items():
        spent = np.median([_seconds(getattr(passes, name))[0] for _ in range(turns)])
        roof = (pair * pairs + particle * len(flow.particles)) / speed
        rows.append((name, 1e9 * spent / pairs, 1e9 * roof / pairs))
    return rows


def _seconds(act):
    began = time.process_time()
    result = act()
    return time.process_time() - began, result


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.passes", description=__doc__)
    parser.add_argument("--spacing", type=float, default=0.004, metavar="D0", help="[m]")
    parser.add_argument("--turns", type=int, default=7)
    options = parser.parse_args(arguments)
    print("| pass | ns a pair | plain, ns a pair | ratio | difference | share of roofline |")
    print("|---|---|---|---|---|---|")
    for name, fast, slow, off, share in compare(settled(options.spacing), options.turns):
        print(f"| {name} | {fast:.1f} | {slow:.0f} | {slow / fast:.0f} | {off:.0e} | {share:.2f} |")


if __name__ == "__main__":
    main()
