"""Solvers of the pressure equation; the file name is the option ``scheme.solver``.

Each module has one function::

    solve(system, x, tolerance, max_iterations) -> mpslab.sparse.SolverReport

which starts from ``x`` and leaves the solution there, and a flag ``BY_SLAB``: whether it wants
the rows by slab, as all solvers do that run on many ranks, or in the order of the particles.  With
``NEEDS_GHOST_ROWS = True`` the rows of all ghosts have their couplings, else only those next to the
border: a solver that takes couplings of ghosts without it depends on the number of ranks.
"""
