"""Puts the water in order before the start.

Particles do not stay on the lattice on which they are laid out: it gives way within some 20 steps,
everywhere at once, and the number density changes by some thousandths.  If water had to follow in
so short a time, its pressure would have to change by that share times the square of the layers:
with 60 layers the pressure fell to nothing and rose to five times its value, with 120 it tore the
water apart.
"""

from functools import partial

import numpy as np

from mpslab.core.bed import CLOSEST
from mpslab.core.particles import FILLER, joined, make_particles
from mpslab.models.stabilisers import corrected_shifting
from mpslab.run import step
from mpslab.solids import filling

SHAKE = 0.1  # spacings: a random displacement, from which the water finds its order
MOMENTUM = 0.9  # share of the last displacement that goes into the next
CALM = 10  # passes without momentum, in which the shake dies down
LONGEST = 0.1  # spacings: displacement in a pass
PASS = 1.0  # a pass is a pace
SETTLED = 1e-4  # spacings: rms of the displacements, momentum aside, at which the passes end


def settle(flow):
    """Shake the water and shift it to where its particles stay, in ``scheme.settling`` passes.

    The displacements are those of the stabiliser `corrected_shifting`, with momentum (Polyak's
    heavy ball), until next to nothing is left of them: what is left presses on the water with the
    weight of all above it, and sets it in motion.

    Meanwhile a lid of particles lies on the water. Below it the water finds its order as it does
    above the bed, and its surface stays level.  Where there is no lid, the surface and the
    particles near it stay as they are, because shifting leaves them alone.  Nothing flows:
    velocities do not change, and the pressure of a particle that moves up or down changes by the
    weight of the water between.
    """
    if flow.case.scheme.settling == 0:
        return
    domain = flow.domain
    count = 1 + max(domain.from_all(int(flow.particles.gid.max(initial=0))))
    _close(flow, count)
    move = np.zeros_like(flow.particles.position)
    for turn in range(flow.case.scheme.settling):
        flow.particles, (move,) = domain.share_out(flow.particles, move, idle=flow.idle)
        step.find_neighbors(flow)
        step.measure(flow)
        step.find_surface(flow)
        if turn == 0:
            _shake(flow, count)
        shift = _shift(flow)
        move = _capped(shift + (MOMENTUM if turn >= CALM else 0.0) * move, flow.stencil.spacing)
        _displace(flow, move)
        flow.particles, (shift, move) = domain.without_ghosts(flow.particles, shift, move)
        if turn >= CALM and _rms(flow, shift) <= SETTLED * flow.stencil.spacing:
            break
    flow.particles = domain.keep(flow.particles, flow.particles.gid < count)


def _close(flow, count):
    """Add the lid to the particles of this rank, numbered from `count` on."""
    from scipy.spatial import cKDTree

    domain = flow.domain
    sites = filling.lid(flow.case)
    seen, _ = domain.share_out(flow.particles)
    solid = seen.position[~seen.fluid]
    flow.particles = domain.without_ghosts(seen)
    slab = domain.slabs.of(sites[:, 0])
    mine = np.flatnonzero((domain.begin <= slab) & (slab < domain.end))
    apart = cKDTree(solid).query(sites[mine])[0] if len(solid) else np.inf
    mine = mine[apart > CLOSEST * flow.stencil.spacing]
    lid = make_particles(sites[mine], np.full(len(mine), FILLER))
    lid.gid = count + mine
    flow.particles = joined(flow.particles, lid)


def _shake(flow, count):
    """Displace the water at random, by gid, where it has no open surface in reach."""
    particles, neighbors, case = flow.particles, flow.neighbors, flow.case
    at_surface = np.append(0, np.cumsum(particles.surface.take(neighbors.indices), dtype=int))
    inside = particles.fluid & (particles.surface == 0)
    inside &= np.diff(at_surface[neighbors.indptr]) == 0
    random = np.random.default_rng([case.particles.seed, 1])
    move = random.uniform(-1.0, 1.0, (count, 3))[np.minimum(particles.gid, count - 1)]
    if flow.stencil.dim == 2:
        move[:, 1] = 0.0
    particles.position += SHAKE * case.particles.spacing * inside[:, np.newaxis] * move
    flow.domain.refresh(particles.position)
    step.measure(flow)


def _shift(flow):
    """Displacement of `corrected_shifting` at the present places, (n, 3) [m]."""
    particles = flow.particles
    start = particles.position.copy()
    corrected_shifting.stabilise(flow.near, PASS, PASS, flow.case.scheme)
    shift = particles.position - start
    particles.position[:] = start
    return shift


def _capped(move, spacing):
    """Displacements (n, 3) [m], none longer than the longest."""
    length = np.sqrt(np.einsum("ij,ij->i", move, move))
    return move * (LONGEST * spacing / np.maximum(length, LONGEST * spacing))[:, np.newaxis]


def _displace(flow, move):
    particles = flow.particles
    particles.position += move
    x, y, z = (flow.case.fluid.density * step.force_on(flow, 0.0) * move).T
    particles.pressure += x + y + z
    if flow.stencil.width > 0.0:
        particles.position[:, 1] %= flow.stencil.width


def _rms(flow, shift):
    """Root of the mean square of displacements (n, 3) of the water of all ranks [m]."""
    water = np.flatnonzero(flow.particles.fluid)
    shift, total = shift.take(water, 0), partial(flow.domain.total, rows=water)
    return np.sqrt(total(np.einsum("ij,ij->i", shift, shift)) / total(np.ones(len(water))))
