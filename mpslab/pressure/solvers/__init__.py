"""Solvers of the pressure equation; the file name is the option ``scheme.solver``.

Each module has one function::

    solve(system, x, tolerance, max_iterations) -> mpslab.pressure.system.SolverReport

which starts from ``x`` and leaves the solution there, and a flag ``BY_SLAB``: whether it works slab
by slab, as all solvers do that run on many ranks.  Rows are in the order of the particles, and so
slab by slab, and in a slab cell by cell.  With ``NEEDS_GHOST_ROWS = True`` the rows of all ghosts
have their couplings, else only those of ghosts next to the border: a solver that uses couplings of
ghosts without this flag gives results that depend on the number of ranks.
"""
