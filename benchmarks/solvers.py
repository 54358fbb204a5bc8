"""``python -m benchmarks.solvers``: the pressure solvers, and those of libraries, side by side.

Systems are taken from runs of the paper's tank in 3-D, each solver starts from nothing, set-up
counts, and all solve to the same residual. Libraries that are not installed are left out.
"""

import argparse
import json
import time

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import LinearOperator, cg

from mpslab import Simulation, load_case
from mpslab.core import plugins
from mpslab.output.provenance import environment

OURS = ("deflated", "scg", "piccg", "iccg")
STEPS = 3  # before a system is taken
MOST = 5000  # iterations


class Taken(Exception):
    """Carries the system out of the step that made it."""


class _Taker:
    """Stands in for the solver of a run."""

    BY_SLAB, NEEDS_GHOST_ROWS = True, True

    @staticmethod
    def solve(system, x, tolerance, max_iterations):
        raise Taken(system)


def take_system(spacing):
    """Pressure system of the paper's tank after some steps, a `PressureSystem`."""
    run = Simulation(load_case("plunging_breaker", {"particles.spacing": spacing}))
    for _ in range(STEPS):
        run.advance()
    run._flow.solver = _Taker
    try:
        run.advance()
    except Taken as taken:
        return taken.args[0]


def matrix_of(system):
    """The whole matrix for the libraries, csr."""
    shape = (len(system), len(system))
    value = system.value.astype(float)
    beside = csr_matrix((value, system.column, system.row), shape=shape)
    return (beside + diags(system.diagonal)).tocsr()


def ours(name):
    """A solver of mpslab as a function of (system, matrix, tolerance) to (x, iterations)."""

    def solve(system, _, tolerance):
        x = np.zeros(len(system))
        report = plugins.load("solvers", name).solve(system, x, tolerance, MOST)
        return x, report.iterations

    return solve


def scipy_jacobi(system, matrix, tolerance):
    """Conjugate gradients of scipy with the diagonal."""
    inverse = 1.0 / matrix.diagonal()
    shape = LinearOperator(matrix.shape, matvec=lambda r: inverse * r)
    return _scipy(matrix, system.right, tolerance, shape)


def pyamg_sa(system, matrix, tolerance):
    """Conjugate gradients of scipy with smoothed aggregation of pyamg."""
    import pyamg

    levels = pyamg.smoothed_aggregation_solver(matrix)
    return _scipy(matrix, system.right, tolerance, levels.aspreconditioner())


def _scipy(matrix, right, tolerance, preconditioner):
    count = [0]
    x, _ = cg(matrix, right, rtol=tolerance, maxiter=MOST, M=preconditioner,
              callback=lambda _: count.__setitem__(0, count[0] + 1))  # fmt: skip
    return x, count[0]


def petsc(kind):
    """Conjugate gradients of PETSc with a preconditioner of its own."""

    def solve(system, matrix, tolerance):
        from petsc4py import PETSc

        index = matrix.indptr.astype(PETSc.IntType), matrix.indices.astype(PETSc.IntType)
        a = PETSc.Mat().createAIJ(matrix.shape, csr=(*index, matrix.data))
        x, b = a.createVecs()
        b.setArray(system.right)
        solver = PETSc.KSP().create()
        solver.setOperators(a)
        solver.setType("cg")
        solver.getPC().setType(kind)
        solver.setTolerances(rtol=tolerance, max_it=MOST)
        solver.solve(b, x)
        return x.getArray().copy(), solver.getIterationNumber()

    return solve


SOLVERS = {
    **{name: ours(name) for name in OURS},
    "scipy, Jacobi": scipy_jacobi,
    "pyamg, smoothed aggregation": pyamg_sa,
    "PETSc, ICC(0)": petsc("icc"),
    "PETSc, Jacobi": petsc("jacobi"),
    "PETSc, GAMG": petsc("gamg"),
}


def measure(system, tolerance, turns):
    """Of each solver that is installed: median seconds, iterations, residual; a dict of dicts."""
    matrix, found = matrix_of(system), {}
    for turn in range(turns):
        for name, solve in SOLVERS.items():
            began = time.perf_counter()
            try:
                x, iterations = solve(system, matrix, tolerance)
            except ImportError:
                continue
            seconds = time.perf_counter() - began
            if turn == 0:
                residual = np.linalg.norm(system.right - matrix @ x)
                residual /= np.linalg.norm(system.right)
                found[name] = {"iterations": iterations, "residual": residual, "seconds": []}
            found[name]["seconds"].append(seconds)
    return {n: {**f, "seconds": float(np.median(f["seconds"]))} for n, f in found.items()}


def table(results):
    """Lines of a table, a pair of columns a size."""
    sizes = list(results)
    head = [f"{rows:,} rows, s | iterations | to deflated" for rows in sizes]
    lines = [f"| solver | {' | '.join(head)} |", "|---" * (1 + 3 * len(sizes)) + "|"]
    for name in results[sizes[0]]:
        cells = []
        for rows in sizes:
            found, best = results[rows][name], results[rows]["deflated"]["seconds"]
            ratio = found["seconds"] / best
            cells += [f"{found['seconds']:.4g}", f"{found['iterations']}", f"{ratio:.1f}"]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return lines


def main(arguments=None):
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.solvers", description=__doc__)
    parser.add_argument("--spacing", type=float, nargs="+", default=[0.004, 0.002, 0.001],
                        metavar="D0", help="of the tanks they are taken from [m]")  # fmt: skip
    parser.add_argument("--tolerance", type=float, default=1e-8, help="|b - A x| / |b|")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--json", metavar="FILE", help="keep all that was measured")
    options = parser.parse_args(arguments)
    results = {}
    for spacing in options.spacing:
        system = take_system(spacing)
        results[len(system)] = measure(system, options.tolerance, options.turns)
    print("\n".join(table(results)))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({**environment(), "tolerance": options.tolerance, "results": results}, file,
                      indent=1)  # fmt: skip


if __name__ == "__main__":
    main()
