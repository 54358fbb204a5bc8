"""Models that keep the particles in order; the file names are the options ``scheme.stabiliser``.

Each module has one function::

    stabilise(particles, before, neighbors, stencil, correction, dt, scheme)

which changes ``particles.position`` and ``particles.velocity`` in place, and a word ``STAGE``:
"predicted" (before the pressure is solved) or "corrected" (at the end of the step, when
``before`` holds the predicted positions, (n, 3) [m]).  ``correction`` holds the matrices of
mpslab.correction, (n, 6), None without ``NEEDS_CORRECTION``.

For the force on a solid it is called once more, with the pairs of the water with this solid alone:
what it does to a velocity has to be a sum over pairs.  A module whose ``stabilise`` is several such
passes says how many, ``PASSES``, and has them as ``one_pass``, with the same arguments.  One that
changes no velocity says ``KEEPS_VELOCITY = True``, and is not called again.
"""
