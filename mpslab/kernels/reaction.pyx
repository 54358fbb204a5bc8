"""The pairs by which solids act on the water."""
from mpslab.kernels.pair cimport FLUID


def with_solids(const signed char[::1] role, const int[::1] indptr, const int[::1] indices,
                int[::1] first, int[::1] found):
    """Of a neighbour list, the pairs of water with solids, as such a list.

    first : (n + 1,) out;  found : out, as long as `indices`

    Returns how many there are.
    """
    cdef Py_ssize_t i, k, count = 0
    with nogil:
        for i in range(indptr.shape[0] - 1):
            first[i] = count
            for k in range(indptr[i], indptr[i + 1] if role[i] == FLUID else indptr[i]):
                found[count] = indices[k]
                count += role[indices[k]] != FLUID
        first[indptr.shape[0] - 1] = count
    return count
