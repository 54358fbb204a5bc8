"""Libraries that take long to load, loaded when they are first used."""

import importlib


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


scipy = Later("scipy")
