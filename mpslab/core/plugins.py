"""Finds a model by its name: one model is one module, and its file name is its name in the case.

A model of the user is found by the name that `add` gave it, or by that of its module: a name with a
dot, "waves.steep", is imported.
"""

import difflib
import importlib
import pkgutil

from mpslab.core.keys import CaseError, require, require_choice

# The key by which a case chooses from each family (a package of mpslab).
KEYS = {
    "gradients": "scheme.gradient",
    "sources": "scheme.source",
    "laplacians": "scheme.laplacian",
    "solvers": "scheme.solver",
    "stabilisers": "scheme.stabiliser",
    "wavemakers": "wavemaker.type",
}
# The folder that the package of a family is in, where it is not mpslab itself.
FOLDERS = {
    "gradients": "models",
    "sources": "models",
    "laplacians": "models",
    "stabilisers": "models",
    "solvers": "pressure",
    "wavemakers": "solids",
}
# What a model of each family has, whatever else it may have.
CONTRACTS = {
    "gradients": ("gradient", "CONSERVES_MOMENTUM"),
    "sources": ("source",),
    "laplacians": ("pair_terms",),
    "solvers": ("solve", "BY_SLAB"),
    "stabilisers": ("stabilise", "STAGE"),
    "wavemakers": ("make",),
}

_added = {}


def package(family):
    """Name of a family's package."""
    return ".".join(filter(None, ["mpslab", FOLDERS.get(family), family]))


def names(family: str) -> tuple[str, ...]:
    """Names of a family's models, sorted; a module whose name starts with "_" is not a model."""
    path = importlib.import_module(package(family)).__path__
    found = {module.name for module in pkgutil.iter_modules(path)}
    found = {name for name in found if not name.startswith("_")}
    return tuple(sorted(found | {name for where, name in _added if where == family}))


def add(family, name, model):
    """Let cases choose a model of the user's own, until the program ends.

    A run that goes on in another program finds it if a module holds it by a name
    (`mpslab.core.own`); else it must be added again.

    Parameters
    ----------
    family : str
        "gradients", "sources", "laplacians", "solvers", "stabilisers" or "wavemakers".
    name : str
        As the case says it, ``scheme.gradient = NAME``; not one of mpslab's own.
    model : module or object
        With the functions and the words of the family's contract, that of its package.

    Raises
    ------
    ValueError
        If it cannot have this name, or lacks what the contract asks for.
    """
    require_choice("family", family, tuple(KEYS))
    fits = isinstance(name, str) and name.isidentifier() and not name.startswith("_")
    require(fits, "name", name, "a word of letters, digits and _")
    taken = name in names(family) and (family, name) not in _added
    require(not taken, "name", name, f"another name than {', '.join(names(family))}")
    _check(family, name, model)
    _added[family, name] = model


def added(case):
    """Family and name of the models that a case has of those that were added, a list of pairs."""
    return [[family, name] for family, name in _added if name in _chosen(case, family)]


def has(family, name):
    """Whether a model is mpslab's own or was added."""
    return name in names(family)


def load(family: str, name: str):
    """Module of the model `name` of a family; if it was added, the object that `add` was given.

    Raises ValueError with the key, the choices and the nearest of them if there is no such model.
    """
    if (family, name) in _added:
        return _added[family, name]
    if is_path(name):
        return _imported(family, name)
    choices = names(family)
    if name not in choices:
        nearest = difflib.get_close_matches(str(name), choices, n=1)
        hint = f"; did you mean {nearest[0]!r}?" if nearest else ""
        raise ValueError(
            f"{KEYS[family]} = {name!r}: unknown; choose one of {', '.join(choices)}{hint}"
        )
    return importlib.import_module(f"{package(family)}.{name}")


def is_path(name):
    """Whether a name is that of a module, or of what is in one: words with dots between."""
    parts = name.split(".") if isinstance(name, str) else []
    return len(parts) > 1 and all(part.isidentifier() for part in parts)


def _imported(family, name):
    try:
        model = pkgutil.resolve_name(name)
    except Exception as error:
        reason = " ".join(str(error).split())
        raise CaseError(
            f"{KEYS[family]} = {name!r}: cannot be imported ({reason}); must be a module on "
            "Python's path, or what is in one"
        ) from error
    _check(family, name, model)
    return model


def _check(family, name, model):
    """Raise CaseError unless a model has what its family's contract asks for."""
    lacks = [what for what in CONTRACTS[family] if not hasattr(model, what)]
    if lacks:
        raise CaseError(
            f"{KEYS[family]} = {name!r}: has no {' and no '.join(lacks)}; must have what "
            f"{package(family)} asks for"
        )


def _chosen(case, family):
    """Names of the models that a case has of a family."""
    table, key = KEYS[family].split(".")
    value = getattr(getattr(case, table), key)
    return value if isinstance(value, tuple) else (value,)
