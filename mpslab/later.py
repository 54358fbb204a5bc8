"""What takes long to load, loaded when it is first used."""

import importlib.util
import pkgutil
import sys


class Later:
    """Stands for a module until something of it is asked for.

    Parameters
    ----------
    name : str
    """

    def __init__(self, name):
        self._name = name

    def __getattr__(self, name):
        return getattr(importlib.import_module(self._name), name)


def names_of(package, places):
    """The functions ``__getattr__`` and ``__dir__`` of a package, by which it has its names.

    Parameters
    ----------
    package : str
    places : dict of str to str
        Where each name is: "module:name". What is not among them may be a module of the package.
    """

    def get(name):
        if name in places:
            found = pkgutil.resolve_name(places[name])
            setattr(sys.modules[package], name, found)
            return found
        module = f"{package}.{name}"
        if name.startswith("_") or not importlib.util.find_spec(module):
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return importlib.import_module(module)

    return get, lambda: sorted({*vars(sys.modules[package]), *places})


scipy = Later("scipy")
