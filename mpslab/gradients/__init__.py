"""Models of the pressure gradient; the file name is the option ``scheme.gradient``.

Each module has one function::

    gradient(position, pressure, kind, indptr, indices, stencil, out)

    position : (n, 3) float64 [m];  pressure : (n,) float64 [Pa];  kind : (n,) int8
    indptr, indices : rows of the neighbour list, int32
    stencil : mpslab.stencil.Stencil
    out : (n, 3) float64 [Pa/m], written for fluid particles, zero elsewhere

and two flags that say what it promises: ``CONSERVES_MOMENTUM`` (pair forces between fluid
particles are equal and opposite) and ``EXACT_FOR_LINEAR`` (any arrangement of neighbours).
"""
