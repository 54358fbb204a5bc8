"""Imports go down only: the floors of ARCHITECTURE.md, held by a test."""

import ast
from pathlib import Path

import mpslab

ROOT = Path(mpslab.__file__).parent
FLOORS = {
    6: "tank progress measures film sea launch terminal",
    5: "simulation record results watch output checkpoint vtkhdf snapshots overturning "
    "pictures preflight preflight_text cases initial inputs restart provenance scatter "
    "headings panels catalogue scenes actions analysis paddle_picture",
    4: "step timestep settling",
    3: "gradients sources laplacians solvers stabilisers wavemakers surface walls pressure "
    "deflation conjugate_gradient solids forcings geometry filling friction census "
    "instruments gauges diagnostics parts reaction models",
    2: "balance communicator headcount domain rebalance",
    1: "particles kinds neighbors stencil sparse slabs parameters scheme keys plugins bed paddle "
    "waves breaking stopwatch files journal lock tables series schedule memory columns core",
    0: "kernels theory later",
}
FLOOR_OF = {name: floor for floor, names in FLOORS.items() for name in names.split()}


def modules():
    """Sources of the package but its front door, __init__.py."""
    for path in sorted([*ROOT.rglob("*.py"), *ROOT.rglob("*.pyx")]):
        if path != ROOT / "__init__.py":
            yield path.relative_to(ROOT).with_suffix("").parts[0], path


def imported(path):
    """First names below mpslab that a source imports."""
    if path.suffix == ".pyx":
        lines = [line.split() for line in path.read_text().splitlines()]
        return [w[1].split(".")[1] for w in lines if w[:1] == ["from"] and "mpslab." in w[1]]
    found = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module == "mpslab":
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("mpslab."):
            found.append(node.module.split(".")[1])
    return found


def test_every_module_has_a_floor():
    assert {name for name, _ in modules()} == set(FLOOR_OF)


def test_imports_go_down_or_stay():
    for name, path in modules():
        for other in imported(path):
            assert FLOOR_OF[other] <= FLOOR_OF[name], f"{path} imports {other}"


def test_no_two_modules_import_each_other():
    graph = {}
    for name, path in modules():
        graph.setdefault(name, set()).update(set(imported(path)) - {name})

    def reaches(start, goal, seen=()):
        return any(n == goal or (n not in seen and reaches(n, goal, (*seen, n)))
                   for n in graph[start])  # fmt: skip

    assert [name for name in graph if reaches(name, name)] == []


def test_only_the_domain_speaks_mpi():
    for _, path in modules():
        assert path.stem == "domain" or "mpi4py" not in path.read_text(), path
