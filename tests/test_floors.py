"""Imports go down only: the floors of ARCHITECTURE.md, held by a test."""

import ast
from pathlib import Path

import mpslab

ROOT = Path(mpslab.__file__).parent
FLOORS = {
    6: "tank measures film sea terminal",
    5: "simulation run analysis",
    4: "cases output",
    3: "models pressure instruments",
    2: "solids parallel forcings",
    1: "core",
    0: "kernels theory later",
}
FLOOR_OF = {name: floor for floor, names in FLOORS.items() for name in names.split()}


def modules():
    """First name below mpslab and path of each source of the package but its front door."""
    for path in sorted([*ROOT.rglob("*.py"), *ROOT.rglob("*.pyx")]):
        if path != ROOT / "__init__.py":
            yield path.relative_to(ROOT).with_suffix("").parts[0], path


def dotted(path):
    """Name of a source below mpslab, a package by its folder."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


NAMES = {dotted(path) for _, path in modules()}


def imported(path):
    """Names below mpslab of the sources that a source imports."""
    if path.suffix == ".pyx":
        lines = [line.split() for line in path.read_text().splitlines()]
        wanted = [(w[1], w[3]) for w in lines if w[:1] == ["from"] and "mpslab." in w[1]]
    else:
        wanted = [
            (node.module, alias.name)
            for node in ast.walk(ast.parse(path.read_text()))
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("mpslab")
            for alias in node.names
        ]
    for module, name in wanted:
        below = f"{module}.{name}".removeprefix("mpslab.")
        if module == "mpslab" and below not in NAMES:
            continue
        yield below if below in NAMES else module.removeprefix("mpslab.")


def circles(graph):
    """Names that lead back to themselves."""

    def reaches(start, goal, seen):
        for n in graph.get(start, ()):
            if n == goal or (n not in seen and not seen.add(n) and reaches(n, goal, seen)):
                return True
        return False

    return [name for name in graph if reaches(name, name, set())]


def test_every_folder_has_a_floor():
    assert {name for name, _ in modules()} == set(FLOOR_OF)


def test_imports_go_down_or_stay():
    for name, path in modules():
        for other in imported(path):
            assert FLOOR_OF[other.split(".")[0]] <= FLOOR_OF[name], f"{path} imports {other}"


def test_no_folders_import_each_other():
    graph = {}
    for name, path in modules():
        graph.setdefault(name, set()).update(n.split(".")[0] for n in imported(path))
        graph[name].discard(name)
    assert circles(graph) == []


def test_no_modules_import_each_other():
    assert circles({dotted(path): set(imported(path)) for _, path in modules()}) == []


def test_only_the_domain_speaks_mpi():
    for _, path in modules():
        assert path.stem == "domain" or "mpi4py" not in path.read_text(), path
