"""Models of the pressure gradient; the file name is the option ``scheme.gradient``.

Each module has one function::

    gradient(near, out)

    near : mpslab.core.neighbourhood.Neighbourhood; the pressure is that of its particles, and
        those that are not ``loaded`` act with none
    out : (n, 3) float64 [Pa/m], written for fluid particles, zero elsewhere

and two flags that say what it promises: ``CONSERVES_MOMENTUM`` (pair forces between fluid
particles are equal and opposite) and ``EXACT_FOR_LINEAR`` (any arrangement of neighbours).
"""
