"""Models that keep the particles in order; the file names are the options ``scheme.stabiliser``.

Each module has one function::

    stabilise(near, dt, pace, scheme)

which changes position and velocity of ``near.particles`` in place, and a word ``STAGE``:
"predicted" (before the pressure is solved, when the pairs lie as they were measured) or "corrected"
(at the end of the step, when the particles have moved on from ``near.position``).  A model that
works little by little does so at a rate that does not depend on the step ``dt`` [s]: its share in
the scheme is what it does in the time ``pace`` [s] (`mpslab.core.timestep.pace`). A model that
parts pairs which have come too near does so at once.

For the force on a solid it is called once more, with the pairs of the water with this solid alone:
so the change of a velocity has to be a sum over pairs.  A module whose ``stabilise`` is several
such passes says how many, ``PASSES``, and has them as ``one_pass``, with the same arguments; in it
a particle may see what is within its radius.  One that changes no velocity says
``KEEPS_VELOCITY = True``, and is not called again.
"""
