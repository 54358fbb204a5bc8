"""Displacements that keep particles apart: shifting, dynamic stabilisation, collision."""
from libc.math cimport sqrt

from mpslab.kernels.lanes cimport prepare_squeeze, reached_eight, squeeze
from mpslab.kernels.pair cimport FLUID, distance, has_pressure, wrap


def shift(const double[:, ::1] sums, const unsigned char[::1] moves, double factor,
          double longest, double[:, ::1] position):
    """Move particles by -factor times their sums, by `longest` [m] at most, in place.

    sums : (n, 4) [1/m];  factor : [m2];  moves : (n,), whether a particle may
    """
    cdef double x, y, z, length, scale
    cdef Py_ssize_t i
    with nogil:
        for i in range(moves.shape[0]):
            if not moves[i]:
                continue
            x, y, z = sums[i, 0], sums[i, 1], sums[i, 2]
            length = factor * sqrt(x * x + y * y + z * z)
            scale = factor * (longest / length if length > longest else 1.0)
            position[i, 0] -= scale * x
            position[i, 1] -= scale * y
            position[i, 2] -= scale * z


cdef inline double square(const double* a, const double* b, double width) noexcept nogil:
    """Squared distance of two places, of the nearest image across the tank [m2]."""
    cdef double x = a[0] - b[0], y = wrap(a[1] - b[1], width), z = a[2] - b[2]
    return x * x + y * y + z * z


def moved(const double[:, ::1] position, const double[:, ::1] before, double width,
          float[::1] out):
    """How far each particle has gone [m]; `before` is (n, 4)."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(out.shape[0]):
            out[i] = sqrt(square(&position[i, 0], &before[i, 0], width))


def gone(const double[:, ::1] position, const double[:, ::1] before, double width,
         double distance):
    """Whether a particle has gone farther than a distance [m] from `before`, (n, 3)."""
    cdef double limit = distance * distance
    cdef Py_ssize_t i
    cdef bint found = False
    with nogil:
        for i in range(position.shape[0]):
            if square(&position[i, 0], &before[i, 0], width) > limit:
                found = True
                break
    return found


def closer(const int[::1] row, const int[::1] other, const double[:, ::1] position, double width,
           double distance, int[::1] close_row, int[::1] close_other):
    """Rows of those pairs of a list that are closer than a distance [m]; how many there are.

    position : (n, 3) [m]
    close_row : (n + 1,) out, close_other : (m + 1,) out
    """
    cdef double limit = distance * distance
    cdef Py_ssize_t i, k
    cdef int found = 0
    with nogil:
        for i in range(close_row.shape[0] - 1):
            close_row[i] = found
            for k in range(row[i], row[i + 1]):
                close_other[found] = other[k]
                found += square(&position[other[k], 0], &position[i, 0], width) < limit
        close_row[close_row.shape[0] - 1] = found
    return found


def reached(const int[::1] row, const int[::1] other, const float[::1] inverse,
            const float[::1] reach, int[::1] close_row, int[::1] close_other):
    """Rows of the pairs whose distance is at most the reaches of both together; how many there are.

    inverse : (m + LANES,), 1/r of the pairs [1/m]
    reach : (n,) [m]
    close_row : (n + 1,) out, close_other : (m + 8,) out

    With a hundred-thousandth of slack, because all this is rounded.
    """
    cdef Py_ssize_t i, k, m, pairs = other.shape[0]
    cdef int found = 0, near
    prepare_squeeze()
    with nogil:
        for i in range(close_row.shape[0] - 1):
            close_row[i] = found
            for k in range(row[i], row[i + 1], 8):
                near = reached_eight(&inverse[k], &other[k], &reach[0], reach[i], row[i + 1] - k)
                if k + 8 <= pairs:
                    found += squeeze(&close_other[found], &other[k], near)
                    continue
                for m in range(k, pairs):
                    close_other[found] = other[m]
                    found += near >> (m - k) & 1
        close_row[close_row.shape[0] - 1] = found
    return found


def part(const int[::1] indptr, const int[::1] indices, double[:, ::1] position,
         const double[:, ::1] before, double[:, ::1] velocity, const signed char[::1] role,
         stencil, double closest, double dt, double[:, :, ::1] change):
    """Part pairs closer than `closest` [m], and take their approach from them, in place.

    After Tsuruta et al. 2013:

    dr_i = -s (sqrt(closest^2 - r_perp^2) - r_par) e, along the direction e that the pair had
    before the pressure moved it; s = 1/2 between fluid particles, 1 against a wall.  The velocity
    changes by dr_i/dt, but by no more than the speed at which the pair approaches: parting a pair
    that something else has pushed together must not make energy.

    indptr, indices : of pairs that may be so close (`close`)
    before : (n, 4) [m], the fourth number 0
    change : (n, 2, 3) scratch
    """
    cdef double width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, ex, ey, ez, r, rr, par, along, push, approach, share
    cdef double sx, sy, sz, ux, uy, uz
    cdef Py_ssize_t i, k, j, a
    with nogil:
        for i in range(indptr.shape[0] - 1):
            if role[i] != FLUID or indptr[i] == indptr[i + 1]:
                continue
            sx = sy = sz = ux = uy = uz = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                rr = dx * dx + dy * dy + dz * dz
                if rr >= closest * closest or not has_pressure(role[j]):
                    continue
                ex = before[j, 0] - before[i, 0]
                ey = wrap(before[j, 1] - before[i, 1], width)
                ez = before[j, 2] - before[i, 2]
                r = distance(ex, ey, ez, floor)
                ex /= r
                ey /= r
                ez /= r
                par = dx * ex + dy * ey + dz * ez
                along = closest * closest - (rr - par * par)
                push = sqrt(along if along > 0.0 else 0.0) - par
                if push <= 0.0:
                    continue
                approach = ((velocity[i, 0] - velocity[j, 0]) * ex
                            + (velocity[i, 1] - velocity[j, 1]) * ey
                            + (velocity[i, 2] - velocity[j, 2]) * ez)
                approach = min(max(approach, 0.0), push / dt)
                share = 0.5 if role[j] == FLUID else 1.0
                sx -= share * push * ex
                sy -= share * push * ey
                sz -= share * push * ez
                ux -= share * approach * ex
                uy -= share * approach * ey
                uz -= share * approach * ez
            change[i, 0, 0], change[i, 0, 1], change[i, 0, 2] = sx, sy, sz
            change[i, 1, 0], change[i, 1, 1], change[i, 1, 2] = ux, uy, uz
        for i in range(indptr.shape[0] - 1):
            if role[i] == FLUID and indptr[i] < indptr[i + 1]:
                for a in range(3):
                    position[i, a] += change[i, 0, a]
                    velocity[i, a] += change[i, 1, a]


def collision(const int[::1] indptr, const int[::1] indices, const double[:, ::1] position,
              const double[:, ::1] velocity, const signed char[::1] role, stencil,
              double closest, double restitution, double[:, ::1] out):
    """Change of velocity where approaching pairs are closer than `closest` [m/s].

    du_i = -(1 + restitution) s (u_i - u_j).e e, with s = 1/2 between equal particles and 1
    against a wall (Shibata, Murotani & Koshizuka 2014).

    indptr, indices : of pairs that may be so close (`close`)
    """
    cdef double width = stencil.width, floor = stencil.floor
    cdef double dx, dy, dz, r, approach, sx, sy, sz
    cdef Py_ssize_t i, k, j
    with nogil:
        for i in range(indptr.shape[0] - 1):
            out[i, 0] = out[i, 1] = out[i, 2] = 0.0
            if role[i] != FLUID:
                continue
            sx = sy = sz = 0.0
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                dx = position[j, 0] - position[i, 0]
                dy = wrap(position[j, 1] - position[i, 1], width)
                dz = position[j, 2] - position[i, 2]
                r = distance(dx, dy, dz, floor)
                if r >= closest:
                    continue
                approach = ((velocity[i, 0] - velocity[j, 0]) * dx
                            + (velocity[i, 1] - velocity[j, 1]) * dy
                            + (velocity[i, 2] - velocity[j, 2]) * dz) / r
                if approach <= 0.0:
                    continue
                approach *= (1.0 + restitution) * (0.5 if role[j] == FLUID else 1.0) / r
                sx -= approach * dx
                sy -= approach * dy
                sz -= approach * dz
            out[i, 0] = sx
            out[i, 1] = sy
            out[i, 2] = sz
