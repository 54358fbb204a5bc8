"""Small tanks, lattices and clouds of particles that the tests share."""

import csv
from types import SimpleNamespace

import numpy as np
from scipy.spatial import cKDTree

from mpslab import instruments
from mpslab.cases import from_tables
from mpslab.core.columns import PHASE_COLUMNS, STEP_COLUMNS
from mpslab.core.neighbors import NeighborList
from mpslab.core.neighbourhood import Neighbourhood
from mpslab.core.particles import make_particles
from mpslab.core.stencil import make_stencil
from mpslab.run.flow import make_flow
from mpslab.run.step import advance
from mpslab.solids import layout
from mpslab.solids.collection import solids_of
from mpslab.solids.piston import make_paddle

TABLES = {
    "tank": {"length": 0.04, "depth": 0.02},
    "particles": {"spacing": 0.002, "jitter": 0.0},
    "time": {"end": 1.0},
    "scheme": {"settling": 0},
}


# What pairs in single precision leave of "exact", of the largest value.
SINGLE = 1e-6

# The frame of the original method, in which the gradients are compared with one another.
CLASSIC = {
    "scheme.source": "mixed",
    "scheme.projection": "predicted",
    "scheme.walls": "solved",
    "scheme.surface": "marked",
    "scheme.stabiliser": ["shifting", "ds"],
    "scheme.gamma": 0.01,  # 0.005 in a largest step of the predicted projection
}


def make_case(changes=None):
    """Closed 2-D tank of 20 x 10 particles; `changes` replaces values by key, "tank.depth"."""
    tables = {name: dict(values) for name, values in TABLES.items()}
    for key, value in (changes or {}).items():
        table, _, name = key.partition(".")
        if name:
            tables.setdefault(table, {})[name] = value
        else:
            tables[table] = value
    return from_tables(tables, "test")


def flow_of(case, keep=None):
    """Flow of a case at t = 0; `keep` picks particles from the set."""
    paddle = make_paddle(case)
    particles = layout.build_particles(case, paddle.backmost if paddle else 0.0)
    if keep is not None:
        particles = particles.take(keep(particles))
    return make_flow(case, particles, solids_of(case, paddle), layout.period(case))


def run(flow, steps, dt):
    """Advance a flow by equal steps, and leave it in the order of gid; every solve converges."""
    for _ in range(steps):
        assert advance(flow, dt).converged
    flow.particles = flow.domain.by_gid(flow.particles)
    return flow


def lattice(dim, half):
    """Cubic lattice of (2 half + 1)^dim points about the origin, spacing 1, (n, 3)."""
    line = np.arange(-half, half + 1.0)
    across = line if dim == 3 else np.zeros(1)
    return np.stack(np.meshgrid(line, across, line, indexing="ij"), axis=-1).reshape(-1, 3)


def inside(position, half):
    """Mask of the points whose coordinates are all at most `half`."""
    return np.abs(position).max(axis=1) <= half


def cloud(dim, n, seed, jitter=None):
    """Random points at one per unit volume, or a shaken lattice of at least n points; (n, 3)."""
    random = np.random.default_rng(seed)
    side = n ** (1.0 / dim)
    if jitter is None:
        position = random.uniform(-0.5 * side, 0.5 * side, (n, 3))
    else:
        position = lattice(dim, int(np.ceil((side - 1.0) / 2.0)))
        position += random.uniform(-jitter, jitter, position.shape)
    if dim == 2:
        position[:, 1] = 0.0
    return position


def neighbors_of(position, radius, width=0.0, active=None):
    """Neighbour list of positions."""
    return NeighborList().build(np.ascontiguousarray(position), radius, width, active)


def near_of(particles, dim, radius=2.1, width=0.0, reach=None, active=None):
    """Neighbourhood of particles at spacing 1; `reach` is that of the list [spacings]."""
    found = neighbors_of(particles.position, reach or radius, width, active)
    return Neighbourhood(make_stencil(dim, 1.0, radius, width)).measure(particles, found)


def closest(position):
    """Least distance of two points."""
    return cKDTree(position).query(position, k=2)[0][:, 1].min()


def number_density_over_n0(case, particles, radius=2.1):
    """n/n0 of all particles of a case at a radius [spacings], (n,)."""
    spacing, width = case.particles.spacing, layout.period(case)
    stencil = make_stencil(case.dim, spacing, radius, width)
    found = neighbors_of(particles.position, stencil.radius, width)
    return Neighbourhood(stencil).measure(particles, found).number_density / stencil.n0


def particles_at(position, role=0):
    """Particles at rest, all fluid unless `role` says something else."""
    return make_particles(position, np.broadcast_to(role, len(position)))


def scheme(**changes):
    """The keys of a scheme that models read, with the values of the standard recipe."""
    values = {
        "relaxation": 0.2, "gamma": 0.005, "shifting_strength": 0.1, "ds_distance": 0.9,
        "collision_distance": 0.5, "restitution": 0.2,
    }  # fmt: skip
    return SimpleNamespace(**{**values, **changes})


def csv_rows(path, without=("seconds",)):
    """Rows of a table but for some columns, a list of dict."""
    with path.open(newline="", encoding="utf-8") as file:
        return [{k: v for k, v in r.items() if k not in without} for r in csv.DictReader(file)]


def open_tables(folder, gauges=(), probes=(), step=None, time=None):
    """Open the tables of a run folder, cut at a step and time, for gauges and probes by name."""
    place = {"x": 0.02, "z": 0.01}
    case = make_case({"gauge": [{"name": name, "x": 0.02} for name in gauges],
                      "probe": [{"name": name, **place} for name in probes]})  # fmt: skip
    for name, one in instruments.of(case).items():
        folder.open_table(name, one.columns, step if one.columns[0] == "step" else time)
    folder.open_table("phases", PHASE_COLUMNS, step)


def add_step(folder, **entries):
    """Add a row to steps.csv, by the keys of its columns."""
    folder.add_rows("steps", [[entries[key] for key in STEP_COLUMNS]])
