"""Vectors of particles, (n, 3) float64: numpy is slow with rows of three numbers."""


def take(const double[:, ::1] vectors, const int[::1] order, double[:, ::1] out):
    """out = the rows `order` of the vectors."""
    cdef Py_ssize_t i
    cdef int j
    with nogil:
        for i in range(order.shape[0]):
            j = order[i]
            out[i, 0], out[i, 1], out[i, 2] = vectors[j, 0], vectors[j, 1], vectors[j, 2]


def pad(const double[:, ::1] vectors, double[:, ::1] out):
    """out (n, 4) = the vectors with a fourth number, 0."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(out.shape[0]):
            out[i, 0], out[i, 1], out[i, 2] = vectors[i, 0], vectors[i, 1], vectors[i, 2]
            out[i, 3] = 0.0


def add(double[:, ::1] vectors, const double[:, ::1] change, const unsigned char[::1] mask):
    """Add a change to the vectors in a mask; a change of a single row is added to each of them."""
    cdef Py_ssize_t i, j, each = change.shape[0] > 1
    with nogil:
        for i in range(mask.shape[0]):
            if mask[i]:
                j = i * each
                vectors[i, 0] += change[j, 0]
                vectors[i, 1] += change[j, 1]
                vectors[i, 2] += change[j, 2]


def put(double[:, ::1] vectors, const double[:, ::1] others, const unsigned char[::1] mask):
    """Replace the vectors in a mask by others."""
    cdef Py_ssize_t i
    with nogil:
        for i in range(mask.shape[0]):
            if mask[i]:
                vectors[i, 0] = others[i, 0]
                vectors[i, 1] = others[i, 1]
                vectors[i, 2] = others[i, 2]
