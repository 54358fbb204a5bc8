"""Solvers of the pressure equation; the file name is the option ``scheme.solver``.

Each module has one function::

    solve(system, x, tolerance, max_iterations) -> mpslab.pressure.system.SolverReport

which starts from ``x`` and leaves the solution there, and a flag ``BY_SLAB``: whether it asks in
which slab a row is, as all solvers do that run on many ranks.  Rows are in the order of the
particles, which is one of slabs and of cells.  With
``NEEDS_GHOST_ROWS = True`` the rows of all ghosts have their couplings, else only those next to the
border: a solver that takes couplings of ghosts without it depends on the number of ranks.
"""
