"""What a model sees: the particles, who is near whom, and the geometry of these pairs."""

from copy import copy

import numpy as np

from mpslab.core.particles import no_particles
from mpslab.kernels import density, divergence, measure, moments, repulsion, vectors

# Near the free surface the moment is one-sided and its inverse large: one layer would push the
# next away.  There C = I, and the pair of the conservative gradient is that of p_i + p_j.
LEAST_DETERMINANT = 0.6
LANES = 16  # as in mpslab/kernels/pair.pxd
SLACK = 0.1  # spacings: so much may be missing to a pair that counts as close


class Neighbourhood:
    """Particles and their pairs where the pressure acts, measured once a step.

    The offset of a pair is the difference of two places in double precision, rounded to single:
    r_ji is -r_ij to the last bit.  Sums over pairs are taken in double precision, so that pair
    forces cancel to its rounding.

    Attributes
    ----------
    members : (k,) int or None
        Which of all particles these are, where they are not all.
    particles : ParticleSet
        They may move on; the pairs stay as they were measured.
    stencil : Stencil
        Of gradient and number density.
    loaded : (n,) uint8
        1 for particles that act with a pressure.
    row : (n + 1,) int32
        Row i of the arrays of pairs is ``row[i]:row[i + 1]``.
    solid : (n,) int32
        Where the solid neighbours of a row begin: water comes first, each in the list's order.
    other : (m,) int32
        The neighbour.
    offset : (m + LANES, 4) float32
        r_ij [m] and w/r^2 [1/m2]; what is behind the m pairs means nothing. Smooth solids have
        slid along their face, for water.
    smooth : bool
        Whether solids are smooth.
    straight : (m + LANES, 4) float32
        r_ij [m] as it is, of pairs of water with solids.
    inverse : (m + LANES,) float32
        1/r [1/m].
    position : (n, 4) float64 [m]
        Where the particles were; the fourth number is 0.
    first : (n, 4) float64
        sum_j w r_ij [m] and the number density sum_j w [-].
    second : (n, 3, 4) float64
        For each axis a, sum_j (r_ij)_a w/r^2 times (r_ij, 1) [-, 1/m].
    """

    def __init__(self, stencil):
        self.stencil = stencil
        self.particles, self.members = no_particles(), None
        self.offset, self.inverse = np.empty((0, 4), np.float32), np.empty(0, np.float32)
        self._straight = self.offset
        self._behind = np.empty(0, np.int32)

    def measure(self, particles, neighbors, loaded=None, smooth=False):
        """Take the geometry of the pairs of a list, with the particles where they are.

        The list is taken over: in its rows water is put before solids.

        Parameters
        ----------
        particles : ParticleSet
        neighbors : NeighborList
        loaded : (n,) bool, optional
            Those that act with a pressure, unless they are water and the faces of solids.
        smooth : bool
            Whether solids are smooth: water feels nothing of their particles along the face.
        """
        n, pairs = len(particles), len(neighbors.indices)
        self.particles, self.row = particles, neighbors.indptr
        loaded = particles.carries_pressure if loaded is None else loaded
        self.loaded = loaded.astype(np.uint8)
        self._make_room(pairs, int(np.diff(self.row).max(initial=0)), smooth)
        self.other, self.solid = neighbors.indices, np.empty(n, np.int32)
        self.position = padded(particles.position)
        self.first, self.second = np.empty((n, 4)), np.empty((n, 3, 4))
        self.smooth = smooth
        self.straight = self._straight if smooth else self.offset
        measure.measure(
            self.position, particles.role, self.row, self.other, self.stencil, smooth, self.solid,
            self._behind, self.offset, self.straight, self.inverse, self.first, self.second,
        )  # fmt: skip
        self._correction = self._lean = self._close = self._reached = None
        self._beside = self._disorder = None
        return self

    def measure_as(self, near):
        """Take the geometry of the same pairs from a neighbourhood with another radius."""
        mine = self.stencil, self.offset
        self.__dict__.update(near.__dict__)
        self.stencil, self.offset = mine
        if len(self.offset) != len(near.offset):
            self.offset = np.zeros_like(near.offset)
        self.first, self.second = np.empty_like(near.first), np.empty_like(near.second)
        measure.weigh(
            self.row, self.stencil, near.offset, self.inverse, self.offset, self.first, self.second
        )
        self._correction = self._lean = self._beside = self._disorder = None
        return self

    def _make_room(self, pairs, longest, smooth):
        """Memory is kept from step to step: to fetch new pages costs more than to write to them."""
        if len(self.inverse) < pairs + LANES:
            room = int(1.2 * pairs) + LANES
            self.offset = np.zeros((room, 4), np.float32)
            self.inverse = np.zeros(room, np.float32)
        if smooth and len(self._straight) < len(self.offset):
            self._straight = np.empty_like(self.offset)
        if len(self._behind) < longest:
            self._behind = np.empty(2 * longest, np.int32)

    def of(self, particles):
        """The same pairs, with particles that have the same places but differ in other things."""
        found = copy(self)
        found.particles = particles
        return found

    def only(self, members, row, pairs):
        """Some of the pairs of water with solids, among some particles; what is known of each
        particle stays.

        Parameters
        ----------
        members : (k,) int
            Rows of the particles, in ascending order.
        row : (k + 1,) int32
            Row i of the new arrays of pairs is ``row[i]:row[i + 1]``.
        pairs : (m,) int
            Number of each in the present arrays.
        """
        found, behind = copy(self), np.zeros(LANES, np.int32)
        found.members, found.particles = members, self.particles.take(members)
        found.row, found.solid = row, row[:-1].copy()
        found.other = np.searchsorted(members, self.other.take(pairs)).astype(np.int32)
        pairs = np.append(pairs, behind)
        found.offset, found.inverse = self.offset.take(pairs, 0), self.inverse.take(pairs)
        for name in ("loaded", "position", "first", "second"):
            setattr(found, name, getattr(self, name).take(members, 0))
        if self._correction is not None:
            found._correction = self._correction.take(members, 0)
        found._lean = found._close = found._reached = found._beside = found._disorder = None
        return found

    def pick(self, values):
        """The values of these particles out of those of all, (n, ...) or None."""
        whole = self.members is None or values is None
        return values if whole else values.take(self.members, 0)

    @property
    def number_density(self):
        """n_i = sum_j w(|r_ij|) over all neighbours (Koshizuka & Oka 1996), (n,) float64."""
        return self.first[:, 3]

    @property
    def correction(self):
        """C_i = [(Ds/n0) sum_j w r_ij (x) r_ij / r^2]^-1 over all neighbours (n, 3, 4) [-].

        Khayyer & Gotoh (2011); three columns, whose fourth numbers mean nothing; the identity where
        the determinant of the bracket is below 0.6.
        """
        if self._correction is None:
            self._correction = self.inverted(LEAST_DETERMINANT)
        return self._correction

    def inverted(self, least_determinant, second=None):
        """As `correction`, with another least determinant, or from other moments (n, 3, 4)."""
        out = np.empty_like(self.second)
        second = self.second if second is None else second
        moments.invert(second, self.stencil, least_determinant, out)
        return out

    @property
    def lean(self):
        """S_i = sum_j D_j r_ij w/r^2, D_j being C_j of water and C_i of solids, (n, 4) [1/m].

        The fourth number means nothing.
        """
        if self._lean is None:
            self.adjoint_divergence(np.zeros_like(self.particles.velocity))
        return self._lean

    def adjoint_divergence(self, velocity):
        """sum_j u_ij . D_j r_ij w/r^2 of velocities (n, 3) [m/s], (n,) float64 [1/(m s)].

        Gives `lean` as well, from the same products.
        """
        self._lean = np.empty((len(self.particles), 4))
        divergence.adjoint(self.row, self.solid, self.other, self.offset,
                           np.ascontiguousarray(velocity), self.correction, self._lean)  # fmt: skip
        return self._lean[:, 3].copy()

    def corrected_divergence(self, velocity, least_determinant):
        """sum_j u_ij . B_i r_ij w/r^2 of velocities (n, 3) [m/s], (n,) float64 [1/(m s)].

        B_i is the inverse of the second moment, the identity where its determinant is below a
        least.  Gives `lean` as well, from the same pairs.
        """
        self._lean = np.empty((len(self.particles), 4))
        divergence.corrected(self.row, self.solid, self.other, self.offset, padded(velocity),
                             self.second, self.correction, self.stencil, least_determinant,
                             self._lean)  # fmt: skip
        return self._lean[:, 3].copy()

    @property
    def beside_surface(self):
        """1 for the free surface and what has some of it within the radius, (n,) uint8.

        Where ``particles.surface`` marked it when this was asked for first.
        """
        if self._beside is None:
            self._beside = np.empty(len(self.particles), np.uint8)
            density.beside(
                self.row, self.other, self.offset, self.particles.surface, self._beside
            )
        return self._beside

    @property
    def disorder(self):
        """S_i + C_i m_i of the water, 0 of solids, (n, 4) [1/m]; the fourth number is 0.

        With m_i = sum_j r_ij w/r^2 and S_i of `lean`. The gradient "corrected" makes Ds/n0 of it of
        a pressure of one everywhere: nothing where particles are in order.
        """
        if self._disorder is None:
            self._disorder = np.empty((len(self.particles), 4))
            moments.disorder(self.second, self.correction, self.lean, self.particles.role,
                             self._disorder)  # fmt: skip
        return self._disorder

    def largest_together(self, rate, mine):
        """The largest that water beside one another shares of values (n,) float64; 0 at least.

        Of a particle that is the lesser of its own value and the mean of those of the water within
        the radius, its own among them: so one particle alone counts little.

        Parameters
        ----------
        mine : slice
            Particles to look at.
        """
        return divergence.largest_together(self.row, self.solid, self.other, self.particles.role,
                                           rate, mine.start, mine.stop)  # fmt: skip

    def close(self, distance):
        """Rows of the pairs that may be closer than a distance [m] where the particles are now.

        They are looked for anew when particles have gone so far that others may have come near.

        Returns
        -------
        row : (n + 1,) int32
        other : (m,) int32
        """
        position, width = self.particles.position, self.stencil.width
        slack = SLACK * self.stencil.spacing
        if self._close is not None:
            found, reach, there = self._close
            if distance <= reach and not repulsion.gone(position, there, width, 0.5 * slack):
                return found
        row, other = self._within_reach(distance + slack)
        closer = np.empty_like(row), np.empty(len(other) + 1, np.int32)
        count = repulsion.closer(row, other, position, width, distance + slack, *closer)
        self._close = (closer[0], closer[1][:count]), distance, position.copy()
        return self._close[0]

    def _within_reach(self, distance):
        """As `close`, told from the paths of the particles: more pairs, and for longer.

        Pairs that were as close when they were measured, and those whose two particles have
        together moved by the distance that was missing.
        """
        moved = np.empty(len(self.particles), np.float32)
        repulsion.moved(self.particles.position, self.position, self.stencil.width, moved)
        if self._reached is not None:
            found, reach, path = self._reached
            if distance <= reach and np.all(moved <= path):
                return found
        path = moved + np.float32(0.5 * SLACK * self.stencil.spacing)
        found = np.empty_like(self.row), np.empty(len(self.other) + LANES, np.int32)
        count = repulsion.reached(
            self.row, self.other, self.inverse, path + np.float32(0.5 * distance), *found
        )
        self._reached = (found[0], found[1][:count]), distance, path
        return self._reached[0]


def padded(rows):
    """Vectors with a fourth number, 0: (n, 3) -> (n, 4) float64."""
    out = np.empty((len(rows), 4))
    vectors.pad(rows, out)
    return out
