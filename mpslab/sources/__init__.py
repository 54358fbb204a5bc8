"""Right-hand sides of the pressure equation; the file name is the option ``scheme.source``.

The equation is  -(1/rho) <lap p>_i = b_i  and each module has one function::

    source(position, velocity, number_density, indptr, indices, stencil, dt, scheme, out)

with the predicted positions (n, 3) [m] and velocities (n, 3) [m/s], the number density there,
and  out : (n,) float64 [1/s2].
"""
