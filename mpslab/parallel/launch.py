"""Start a program on many ranks."""

import shutil
import sys
from importlib import metadata
from pathlib import Path


def mpiexec():
    """Path of mpiexec: the one beside this Python, else that of the mpich package, else of the
    system.

    Raises
    ------
    ValueError
        If there is none.
    """
    places = [Path(sys.executable).parent / "mpiexec", *_of_package()]
    found = next((str(place) for place in places if place.is_file()), shutil.which("mpiexec"))
    if found is None:
        raise ValueError(
            f"--ranks: there is no mpiexec beside {sys.executable}; install it with "
            "'pip install mpich', or start with the mpiexec of your own MPI"
        )
    return found


def _of_package():
    try:
        files = metadata.files("mpich") or []
    except metadata.PackageNotFoundError:
        files = []
    return [Path(file.locate()) for file in files if file.name == "mpiexec"]


def command(ranks, *arguments):
    """Command line that runs Python with these arguments on so many ranks, a list of str."""
    return [mpiexec(), "-n", str(ranks), sys.executable, *arguments]
