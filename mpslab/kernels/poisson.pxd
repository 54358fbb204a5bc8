# Pair coefficient of the Laplacian, inlined into the kernels that need it.

cdef inline double coefficient(double r, double radius, double one, double inverse,
                               double cubic) noexcept nogil:
    """Pair coefficient one + inverse/r + cubic/r^3 of the Laplacian, 0 outside the radius."""
    return one + inverse / r + cubic / (r * r * r) if r < radius else 0.0
