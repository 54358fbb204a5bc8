"""Models that keep the particles in order; the file names are the options ``scheme.stabiliser``.

Each module has one function::

    stabilise(near, dt, scheme)

which changes position and velocity of ``near.particles`` in place, and a word ``STAGE``:
"predicted" (before the pressure is solved, when the pairs lie as they were measured) or "corrected"
(at the end of the step, when the particles have moved on from ``near.position``).
"""
