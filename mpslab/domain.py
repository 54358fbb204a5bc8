"""Who owns what: slabs among ranks, ghosts, migration, sums over all ranks.

A rank owns a contiguous run of whole slabs, the particles in them, and sees the particles of the
slab on either side, its ghosts.  A slab is two influence radii wide, so that the neighbours of an
owned particle's neighbours are all there: what a model computes for a ghost next to the border is
what its owner computes, bit by bit, and models need not know about ranks.

One process is a communicator of size one, and runs the same code.  This is the only module that
knows of MPI.
"""

import os
from dataclasses import fields
from functools import cache

import numpy as np

from mpslab import balance, headcount, rebalance
from mpslab.communicator import Alone, Patience, finish, meet, on_root
from mpslab.particles import ParticleSet
from mpslab.stopwatch import COMMUNICATION, WAITING, WORK, Stopwatch


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
    slabs : mpslab.slabs.Slabs
    comm : communicator, optional
        That of `world` unless given.

    Attributes
    ----------
    rank, size : int
    cuts : (size + 1,) int
        Rank k owns the slabs ``cuts[k]`` to ``cuts[k + 1] - 1``.
    slab : (n,) int32
        Slab of each particle, where `share_out` found it.
    owned : (n,) bool
        False for ghosts.
    stopwatch : mpslab.stopwatch.Stopwatch
        Of the step; it also counts what goes into communication and waiting.
    migrated : int
        Particles that came here from other ranks.
    ghosts : int
        How many there were in the last step.
    """

    def __init__(self, slabs, comm=None):
        self.slabs = slabs
        self.comm = comm or world()
        self.rank, self.size = self.comm.rank, self.comm.size
        self.cuts = balance.cut("static", np.zeros(slabs.count), self.size)
        self.slab, self.owned = np.zeros(0, np.int32), np.zeros(0, bool)
        self.stopwatch, self.migrated, self.ghosts = Stopwatch(), 0, 0
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
        """This rank's share of the particles that rank 0 has, cut by a method of `mpslab.balance`.

        What the other ranks hand over does not count; it may be a set without particles.
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
            arrays = _merged(arrays, self._exchange(arrays, shares), mine)
        self.slab = self._slab_of(arrays)
        self.owned = np.ones(len(self.slab), bool)
        return ParticleSet(*arrays)

    def share_out(self, particles, *companions):
        """Send particles to the ranks that own the slabs they are in, then get the ghosts.

        Parameters
        ----------
        particles : ParticleSet, without ghosts
        companions : (n, ...) arrays that go with them

        Returns
        -------
        particles : ParticleSet in the order of gid, ghosts among them
        companions : list of arrays
        """
        if self.size == 1:
            self.slab = self.slabs.of(particles.position[:, 0])
            self.owned = np.ones(len(particles), bool)
            return particles, companions
        arrays = self._share([*arrays_of(particles), *companions])
        count = len(fields(ParticleSet))
        return ParticleSet(*arrays[:count]), arrays[count:]

    def without_ghosts(self, particles):
        """The particles that this rank owns."""
        return particles if self.owned.all() else self.keep(particles, self.owned)

    def keep(self, particles, mask):
        """The particles of a mask."""
        self.slab, self.owned = self.slab[mask], self.owned[mask]
        return particles.take(mask)

    def _share(self, arrays):
        """Arrays of what this rank owns from now on, and of its ghosts, in the order of gid."""
        owner = np.searchsorted(self.cuts, self._slab_of(arrays), side="right") - 1
        leave = [np.flatnonzero(owner == r) if r != self.rank else [] for r in range(self.size)]
        come = self._exchange(arrays, leave)
        self.migrated += sum(len(c[0]) for c in come)
        arrays = _merged(arrays, come, np.flatnonzero(owner == self.rank))
        slab, send = self._slab_of(arrays), [[]] * self.size
        for r in self._beside():
            send[r] = np.flatnonzero(self._seen_by(r, slab))
        arrays = _merged(arrays, self._exchange(arrays, send))
        self._find_halo(self._slab_of(arrays))
        return arrays

    def _find_halo(self, slab):
        """Which particles are owned, and which are seen by the ranks beside or seen of them."""
        self.slab = slab
        self.owned = (self.begin <= slab) & (slab < self.end)
        self.ghosts = int(np.count_nonzero(~self.owned))
        self._halo = []
        for r in self._beside():
            give = np.flatnonzero(self.owned & self._seen_by(r, slab))
            take = np.flatnonzero((self.cuts[r] <= slab) & (slab < self.cuts[r + 1]))
            self._halo.append((r, give, take))

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
        """Send rows[r] of the arrays to each rank r; what comes in, an entry a rank that sends."""
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
        with self.stopwatch.kind(COMMUNICATION):
            requests, sent, came = [], [], []
            for r, give, take in self._halo:
                for a in arrays:
                    came.append((a, take, np.empty((len(take), *a.shape[1:]), a.dtype)))
                    requests.append(self.comm.Irecv(came[-1][2], r))
                    sent.append(a.take(give, 0))
                    requests.append(self.comm.Isend(sent[-1], r))
            self._wait(requests)
            for a, take, values in came:
                a[take] = values

    def refresh_rows(self, x, first):
        """As `refresh` for the rows of the pressure equation; first[s] is the first of slab s."""
        if self.size == 1:
            return
        with self.stopwatch.kind(COMMUNICATION):
            requests = []
            for r in self._beside():
                left = r < self.rank
                mine, theirs = (self.begin, self.begin - 1) if left else (self.end - 1, self.end)
                requests.append(self.comm.Irecv(x[first[theirs] : first[theirs + 1]], r))
                requests.append(self.comm.Isend(x[first[mine] : first[mine + 1]], r))
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

    def total(self, values):
        """Sum of (n,) values over the particles of all ranks, slab by slab."""
        return self.add(np.bincount(self.slab, values, minlength=self.slabs.count))

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
        """As the function `on_root`; for the other ranks that is waiting."""

        def work():
            with self.stopwatch.kind(WORK):
                return act()

        with self.stopwatch.kind(WAITING):
            return on_root(self.comm, work)

    def gather(self, particles):
        """The particles of all ranks in the order of gid on rank 0, None elsewhere."""
        if self.size == 1:
            return particles
        arrays = arrays_of(particles)
        mine = np.arange(len(particles))
        come = self._exchange(arrays, [mine if self.rank else [], *[[]] * (self.size - 1)])
        return ParticleSet(*_merged(arrays, come)) if self.rank == 0 else None


POSITION = [f.name for f in fields(ParticleSet)].index("position")


def arrays_of(particles):
    """The arrays of a ParticleSet, in the order of its fields."""
    return [getattr(particles, f.name) for f in fields(particles)]


def _merged(arrays, come, stay=None):
    """Arrays in the order of the first one, gid: the rows that stay (all unless given), and what
    came put in its place.
    """
    count = len(arrays[0])
    stay = np.arange(count) if stay is None else stay
    if not come and len(stay) == count:
        return arrays
    both = [np.concatenate(parts) for parts in zip(arrays, *come, strict=True)]
    gid = both[0]
    new = count + np.argsort(gid[count:])
    rows = np.insert(stay, np.searchsorted(gid[stay], gid[new]), new)
    return [a.take(rows, 0) for a in both]
