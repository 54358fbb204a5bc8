"""Right-hand sides of the pressure equation; the file name is the option ``scheme.source``.

The equation is  -(1/rho) <lap p>_i = b_i  and each module has one function::

    source(near, velocity, number_density, dt, rate, scheme)

which returns b, (n,) float64 [1/s2].

    near : mpslab.core.neighbourhood.Neighbourhood where the pressure acts
    velocity : (n, 3) float64 [m/s], the predicted velocities
    number_density : (n,) float64 [-]
    rate : float [1/s], at which the mixed sources take a density error back
        (`mpslab.run.step.density_rate`)
    scheme : the table of the case

A module whose divergence is wrong where neighbours lie on one side says ``INSIDE_ONLY = True``: at
a graded surface its b is left out.
"""
