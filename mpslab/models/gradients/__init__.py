"""Models of the pressure gradient; the file name is the option ``scheme.gradient``.

Each module has one function::

    gradient(near, out)

    near : mpslab.core.neighbourhood.Neighbourhood, of ``scheme.gradient_radius``; the pressure is
        that of its particles, and those that are not ``loaded`` act with none
    out : (n, 3) float64 [Pa/m], written for fluid particles, zero elsewhere

and two flags that say what it promises: ``CONSERVES_MOMENTUM`` (pair forces between fluid
particles are equal and opposite) and ``EXACT_FOR_LINEAR`` (any arrangement of neighbours). With
``HAS_RESIDUE = True`` what it makes of a uniform pressure is that of :mod:`mpslab.models.residue`.

For the force on a solid, `gradient` is called once more, with the pairs of the water with this
solid alone. A module whose sums need more than the pair has a second function::

    as_pairs(near) -> gradient, pressure

a gradient that looks at one pair at a time, and a pressure, (n,), with which that gives the same.

Gradients that differ only in what multiplies r_ij w / r^2 share their loop, `_pairs.by_pairs`.
"""
