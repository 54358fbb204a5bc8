"""Who owns what: slabs among ranks, ghosts, migration, sums over all ranks.

A rank owns a contiguous run of whole slabs and the particles in them. It also sees the particles of
the next slab on either side, its ghosts.  A slab is two influence radii wide, so that the
neighbours of an owned particle's neighbours are all there: what a model computes for a ghost next
to the border is what its owner computes, bit by bit, and models need not know about ranks.

Within a step the particles lie in the order of their cells (`mpslab.core.cells`), and so slab by
slab: what a rank owns is one piece of each array, and so is all that it gives to another rank or
gets from it.

One process is a communicator of size one, and runs the same code.  This is the only module that
knows of MPI.
"""

import os
from dataclasses import fields
from functools import cache

import numpy as np

from mpslab.core.cells import make_cells
from mpslab.core.particles import ParticleSet, joined, no_particles
from mpslab.core.stopwatch import COMMUNICATION, WAITING, WORK, Stopwatch
from mpslab.kernels import vectors
from mpslab.parallel import balance, headcount, rebalance
from mpslab.parallel.communicator import Alone, Patience, finish, meet, on_root


def launched():
    """Whether an mpiexec has started this process."""
    return headcount.told(os.environ) is not None


@cache
def world():
    """The communicator of all ranks: that of MPI under mpiexec, else `Alone`.

    All ranks have to call it the first time.

    Raises
    ------
    ValueError
        If MPI cannot be loaded, or knows of fewer processes than the launcher has started.
    """
    if not launched():
        return Alone()
    try:
        from mpi4py import MPI
    except (ImportError, RuntimeError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(
            f"{headcount.claim(os.environ)}, but MPI cannot be loaded ({reason}); install it with "
            "'pip install mpi4py mpich', or start without the launcher"
        ) from error
    headcount.check(os.environ, MPI.COMM_WORLD.size)
    Patience.find(MPI.COMM_WORLD)
    return MPI.COMM_WORLD


class Domain:
    """The part of the tank that a rank owns.

    Parameters
    ----------
    slabs : mpslab.parallel.slabs.Slabs
    comm : communicator, optional
        That of `world` unless given.
    cells : mpslab.core.cells.Cells, optional
        Into which the slabs are divided; unless given, they are divided along x only.

    Attributes
    ----------
    rank, size : int
    cuts : (size + 1,) int
        Rank k owns the slabs ``cuts[k]`` to ``cuts[k + 1] - 1``.
    slab : (n,) int32
        Slab of each particle, where `share_out` found it.
    owned : slice
        The particles that are not ghosts.
    stopwatch : mpslab.core.stopwatch.Stopwatch
        Of the step; it also counts what goes into communication and waiting.
    migrated : int
        Particles that came here from other ranks.
    ghosts : int
        How many there were in the last step.
    aside : ParticleSet
        Those of this rank that have no part in the step.
    """

    def __init__(self, slabs, comm=None, cells=None):
        self.slabs = slabs
        self.cells = cells or make_cells([0.0] * 3, [0.0] * 3, slabs.width, slabs=slabs)
        self.comm = comm or world()
        self.rank, self.size = self.comm.rank, self.comm.size
        self.cuts = balance.cut("static", np.zeros(slabs.count), self.size)
        self.slab, self.owned = np.zeros(0, np.int32), slice(0, 0)
        self.stopwatch, self.migrated, self.ghosts = Stopwatch(), 0, 0
        self.aside = self._whole = no_particles()
        self._halo = []

    @property
    def begin(self):
        """First slab of this rank."""
        return int(self.cuts[self.rank])

    @property
    def end(self):
        """Slab after the last one of this rank."""
        return int(self.cuts[self.rank + 1])

    def ghosts_of(self, rank):
        """The slabs that a rank sees beside its own."""
        return int(self.cuts[rank]) - 1, int(self.cuts[rank + 1])

    def take_part(self, particles, method):
        """This rank's share of the particles that rank 0 has, cut by a method of
        `mpslab.parallel.balance`.

        What the other ranks hand over is not used; it may be a set without particles.
        """
        slab = self.slabs.of(particles.position[:, 0])
        work = rebalance.load(method, particles.fluid, slab, self.slabs.count)
        self.cuts = balance.cut(method, self.comm.bcast(work), self.size)
        arrays, shares = arrays_of(particles), [[]] * self.size
        if self.rank == 0:
            owner = np.searchsorted(self.cuts, slab, side="right") - 1
            shares = [np.flatnonzero(owner == r) for r in range(self.size)]
        mine, shares[0] = np.asarray(shares[0], int), []
        if self.size > 1:
            arrays = _joined(arrays, self._exchange(arrays, shares), mine)
        self.slab = self._slab_of(arrays)
        self.owned = slice(0, len(self.slab))
        return ParticleSet(*arrays)

    def share_out(self, particles, *companions, idle=None):
        """Send particles to the ranks that own the slabs they are in, then get the ghosts.

        Parameters
        ----------
        particles : ParticleSet, without ghosts
        companions : (n, ...) arrays that go with them
        idle : callable, optional
            Takes a `ParticleSet`, ghosts among them, and gives a mask (n,) bool of those that have
            no part in what follows: they are put `aside` until `without_ghosts`, unless another
            rank sees them.

        Returns
        -------
        particles : ParticleSet in the order of the cells, ghosts among them
            Its arrays are to be changed in place.
        companions : list of arrays
        """
        arrays, count = [*arrays_of(particles), *companions], len(fields(ParticleSet))
        if self.size > 1:
            arrays = self._share(arrays)
        off = self._out_of_it(ParticleSet(*arrays[:count]), idle)
        order = self._in_order(np.flatnonzero(~off).astype(np.int32), arrays)
        last = np.append(order, np.flatnonzero(off).astype(np.int32))
        self._whole = ParticleSet(*(_ordered(a, last) for a in arrays[:count]))
        self.aside = self._whole.take(slice(len(order), None))
        particles = self._whole.take(slice(0, len(order)))
        self._find_halo(self.slabs.of(particles.position[:, 0]))
        return particles, [_ordered(a, order) for a in arrays[count:]]

    def _out_of_it(self, particles, idle):
        """Mask of the particles that are put aside, (n,) bool."""
        if idle is None:
            return np.zeros(len(particles), bool)
        off = idle(particles)
        if self.size > 1:
            slab = self.slabs.of(particles.position[:, 0])
            for r in (self.rank, *self._beside()):
                off &= ~self._seen_by(r, slab)
        return off

    def _in_order(self, rows, arrays):
        """Rows (m,) int32 of the arrays, in the order of the cells."""
        return rows.take(self.cells.order(*(_ordered(arrays[k], rows) for k in (POSITION, GID))))

    def without_ghosts(self, particles, *companions):
        """The particles of a step that this rank owns, and behind them those put aside.

        With companions (n, ...) a list of these as well, zero for what was put aside.
        """
        more = len(self.aside)
        if self.ghosts:
            companions = [a[self.owned] for a in companions]
            particles = self.keep(particles, self.owned)
            self._whole = joined(particles, self.aside)
        if more:
            companions = [np.concatenate([a, np.zeros((more, *a.shape[1:]))]) for a in companions]
            particles, self._whole = self._whole, no_particles()
            self.slab = np.append(self.slab, self.slabs.of(self.aside.position[:, 0]))
            self.owned, self.aside = slice(0, len(self.slab)), no_particles()
        return (particles, companions) if companions else particles

    def keep(self, particles, rows):
        """The particles of a mask, index or slice; from then on none counts as a ghost."""
        self.slab = self.slab[rows]
        self.owned = slice(0, len(self.slab))
        return particles.take(rows)

    def by_gid(self, particles):
        """The particles of this rank in the order of gid, in which they are kept from then on."""
        if np.all(particles.gid[1:] > particles.gid[:-1]):
            return particles
        return self.keep(particles, np.argsort(particles.gid))

    def _share(self, arrays):
        """Arrays of what this rank owns from now on, and of its ghosts, in any order."""
        owner = np.searchsorted(self.cuts, self._slab_of(arrays), side="right") - 1
        leave = [np.flatnonzero(owner == r) if r != self.rank else [] for r in range(self.size)]
        come = self._exchange(arrays, leave)
        self.migrated += sum(len(c[0]) for c in come)
        arrays = _joined(arrays, come, np.flatnonzero(owner == self.rank))
        slab, send = self._slab_of(arrays), [[]] * self.size
        for r in self._beside():
            send[r] = np.flatnonzero(self._seen_by(r, slab))
        return _joined(arrays, self._exchange(arrays, send))

    def _find_halo(self, slab):
        """Which particles are owned, which are ghosts here, and which on a neighbouring rank."""
        self.slab = slab
        first = np.searchsorted(slab, np.arange(self.slabs.count + 1)).tolist()
        self.owned = slice(first[self.begin], first[self.end])
        self.ghosts = len(slab) - (self.owned.stop - self.owned.start)
        self._halo = self.halo(first)

    def halo(self, first):
        """What to exchange of rows that lie slab by slab, first[s] the first of slab s.

        A list of (rank, rows that are ghosts there, rows that are its ghosts here), two slices.
        """
        found = []
        for r in self._beside():
            give, take = (self.begin, self.begin - 1) if r < self.rank else (self.end - 1, self.end)
            found.append((r, *(slice(first[s], first[s + 1]) for s in (give, take))))
        return found

    def _seen_by(self, rank, slab):
        """Whether a rank sees the particles in these slabs as ghosts, if it does not own them."""
        left, right = self.ghosts_of(rank)
        return (slab == left) | (slab == right)

    def within_reach(self, x, radius):
        """Whether places x [m] may lie within a radius [m] of a particle in this rank's slabs."""
        slabs = self.slabs
        begin, end = slabs.lower + np.array([self.begin, self.end]) * slabs.width
        margin = radius * (1.0 + 1e-9)
        left = begin - margin if self.begin > 0 else -np.inf
        right = end + margin if self.end < slabs.count else np.inf
        return ~((x < left) | (right < x))  # so that what is not a number has its owner

    def _beside(self):
        """The ranks that own the slabs on either side."""
        return [r for r in (self.rank - 1, self.rank + 1) if 0 <= r < self.size]

    def _slab_of(self, arrays):
        return self.slabs.of(arrays[POSITION][:, 0])

    def _exchange(self, arrays, rows):
        """Send rows[r] of the arrays to each rank r; returns what came in, one entry for each
        sender.
        """
        kind = np.dtype([(str(k), a.dtype, a.shape[1:]) for k, a in enumerate(arrays)])
        with self.stopwatch.kind(COMMUNICATION):
            self._meet()
            counts = self.comm.alltoall([len(r) for r in rows])
            requests, sent, came = [], [], []
            for r in range(self.size):
                if counts[r]:
                    came.append(np.empty(counts[r], kind))
                    requests.append(self.comm.Irecv(came[-1].view(np.uint8), r))
                if len(rows[r]):
                    packed = np.empty(len(rows[r]), kind)
                    for k, a in enumerate(arrays):
                        packed[str(k)] = a.take(rows[r], 0)
                    sent.append(packed)
                    requests.append(self.comm.Isend(packed.view(np.uint8), r))
            self._wait(requests)
            return [[np.ascontiguousarray(c[name]) for name in kind.names] for c in came]

    def refresh(self, *arrays):
        """Give the ghosts' rows of (n, ...) arrays the values of their owners, in place."""
        self.exchange(self._halo, *arrays)

    def exchange(self, halo, *arrays):
        """As `refresh` for arrays of other rows, whose `halo` this is."""
        if self.size == 1:
            return
        with self.stopwatch.kind(COMMUNICATION):
            requests = []
            for r, give, take in halo:
                for a in arrays:
                    requests.append(self.comm.Irecv(a[take], r))
                    requests.append(self.comm.Isend(a[give], r))
            self._wait(requests)

    def _wait(self, requests):
        with self.stopwatch.kind(WAITING):
            finish(requests)

    def _meet(self):
        with self.stopwatch.kind(WAITING):
            meet(self.comm)

    def add(self, by_slab):
        """Sum over all slabs of the sums (slabs,) that their owners give, in the order of slabs."""
        return sum(self.collect(by_slab).tolist())

    def collect(self, values):
        """Values of all slabs or groups, from those that each rank gives for its own, else 0."""
        if self.size == 1:
            return values
        total = np.empty_like(values)
        with self.stopwatch.kind(COMMUNICATION):
            self._wait([self.comm.Iallreduce(values, total)])
        return total

    def total(self, values, rows=None):
        """Sum of values over the particles of all ranks, slab by slab.

        values : (n,), or (m,) of the particles that `rows` (m,) int picks
        """
        slab = self.slab if rows is None else self.slab.take(rows)
        return self.add(np.bincount(slab, values, minlength=self.slabs.count))

    def totals(self, *parts):
        """As `total`, column by column, of values that some particles have, (k,).

        Parameters
        ----------
        parts : pairs of (m,) int and (m, j) float64
            Rows of particles that this rank owns, and their values.
        """
        columns = [
            np.bincount(self.slab[rows], column, self.slabs.count)
            for rows, values in parts
            for column in values.T
        ]
        return sum(self.collect(np.column_stack(columns)))

    def from_all(self, item):
        """What each rank gives, a list in the order of ranks, the same on all of them."""
        with self.stopwatch.kind(COMMUNICATION):
            self._meet()
            return self.comm.allgather(item)

    def on_root(self, act):
        """As the function `on_root`; the other ranks' time counts as waiting."""

        def work():
            with self.stopwatch.kind(WORK):
                return act()

        with self.stopwatch.kind(WAITING):
            return on_root(self.comm, work)

    def gather(self, particles):
        """The particles of all ranks in the order of gid on rank 0, None elsewhere."""
        if self.size > 1:
            arrays, mine = arrays_of(particles), np.arange(len(particles))
            come = self._exchange(arrays, [mine if self.rank else [], *[[]] * (self.size - 1)])
            particles = ParticleSet(*_joined(arrays, come))
        return particles.take(np.argsort(particles.gid)) if self.rank == 0 else None


GID, POSITION = ([f.name for f in fields(ParticleSet)].index(name) for name in ("gid", "position"))


def arrays_of(particles):
    """The arrays of a ParticleSet, in the order of its fields."""
    return [getattr(particles, f.name) for f in fields(particles)]


def _ordered(array, order):
    """Rows of an array (n, ...) in an order (m,) int32."""
    if array.ndim == 1:
        return array.take(order)
    out = np.empty((len(order), *array.shape[1:]))
    vectors.take(array, order, out)
    return out


def _joined(arrays, come, stay=None):
    """Arrays of the rows that stay (all unless given), and of what came."""
    if stay is not None and len(stay) < len(arrays[0]):
        arrays = [a.take(stay, 0) for a in arrays]
    if not come:
        return arrays
    return [np.concatenate(parts) for parts in zip(arrays, *come, strict=True)]
