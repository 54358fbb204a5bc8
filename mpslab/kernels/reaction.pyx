"""The pairs by which solids act on the water."""
from mpslab.kernels.pair cimport FLUID


def with_solids(const signed char[::1] role, const int[::1] row, const int[::1] solid,
                const int[::1] other, const unsigned char[::1] wanted, int[::1] first,
                int[::1] found):
    """Numbers of the pairs of water with the wanted particles of solids.

    row, solid, other : pairs, see mpslab.kernels.measure
    wanted : (n,) 1 for these particles
    first : (n + 1,) out, where the pairs of each particle begin in `found`
    found : out, long enough

    Returns how many there are.
    """
    cdef Py_ssize_t i, k, n = role.shape[0]
    cdef int count = 0
    with nogil:
        for i in range(n):
            first[i] = count
            for k in range(solid[i], row[i + 1] if role[i] == FLUID else solid[i]):
                found[count] = <int>k
                count += wanted[other[k]] != 0
        first[n] = count
    return count
