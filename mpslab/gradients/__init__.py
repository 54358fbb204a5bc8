"""Models of the pressure gradient; the file name is the option ``scheme.gradient``.

Each module has one function::

    gradient(position, pressure, role, indptr, indices, stencil, correction, out)

    position : (n, 3) float64 [m];  pressure : (n,) float64 [Pa];  role : (n,) int8
    indptr, indices : rows of the neighbour list, int32
    stencil : mpslab.stencil.Stencil, of ``scheme.gradient_radius``
    correction : (n, 6) float64, matrices of mpslab.correction; None without NEEDS_CORRECTION
    out : (n, 3) float64 [Pa/m], written for fluid particles, zero elsewhere

and two flags that say what it promises: ``CONSERVES_MOMENTUM`` (pair forces between fluid
particles are equal and opposite) and ``EXACT_FOR_LINEAR`` (any arrangement of neighbours).  A
module of any family that works with the correction matrices says ``NEEDS_CORRECTION = True``.

For the force on a solid, `gradient` is called once more, with the pairs of the water with this
solid alone. A module whose sums need more than the pair has a second function::

    as_pairs(position, pressure, role, indptr, indices, stencil) -> gradient, pressure

a gradient that looks at one pair at a time, and a pressure, (n,), with which that gives the same.
"""
