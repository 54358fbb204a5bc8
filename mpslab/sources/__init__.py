"""Right-hand sides of the pressure equation; the file name is the option ``scheme.source``.

The equation is  -(1/rho) <lap p>_i = b_i  and each module has one function::

    source(position, velocity, role, number_density, indptr, indices, stencil, correction, dt,
           rate, scheme, out)

with the positions (n, 3) [m] where the pressure acts, the predicted velocities (n, 3) [m/s], the
roles (n,) int8, the number density there, the correction matrices (n, 6) of mpslab.correction (None
without ``NEEDS_CORRECTION``), the rate s [1/s] at which the mixed sources take a density error back
(`mpslab.step.density_rate`), and  out : (n,) float64 [1/s2].
"""
