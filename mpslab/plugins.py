"""Finds a model by its name: one model is one module, and its file name is its name in the case."""

import difflib
import importlib
import pkgutil
from types import ModuleType

# The key by which a case chooses from each family (a package of mpslab).
KEYS = {
    "gradients": "scheme.gradient",
    "sources": "scheme.source",
    "laplacians": "scheme.laplacian",
    "solvers": "scheme.solver",
    "stabilisers": "scheme.stabiliser",
    "wavemakers": "wavemaker.type",
}


def names(family: str) -> tuple[str, ...]:
    """Names of a family's models, sorted; a module whose name starts with "_" is not a model."""
    package = importlib.import_module(f"mpslab.{family}")
    found = {module.name for module in pkgutil.iter_modules(package.__path__)}
    return tuple(sorted(name for name in found if not name.startswith("_")))


def load(family: str, name: str) -> ModuleType:
    """Module of the model `name` of a family.

    Raises ValueError with the key, the choices and the nearest of them if there is no such model.
    """
    choices = names(family)
    if name not in choices:
        nearest = difflib.get_close_matches(str(name), choices, n=1)
        hint = f"; did you mean {nearest[0]!r}?" if nearest else ""
        raise ValueError(
            f"{KEYS[family]} = {name!r}: unknown; choose one of {', '.join(choices)}{hint}"
        )
    return importlib.import_module(f"mpslab.{family}.{name}")
