"""What a result was made with: versions, machine, commit."""

import platform
import subprocess
import sys
from functools import cache
from pathlib import Path

from mpslab.parallel.communicator import cores


@cache
def environment():
    """Versions and machine, for the record of a run; worked out once.

    Returns
    -------
    dict
        ``versions`` (of mpslab, python and the libraries; None where a package is not installed),
        ``machine`` (platform, cpu, cores) and ``commit`` (None outside a git checkout).
    """
    return {
        "versions": {
            "mpslab": _version("mpslab"),
            "python": platform.python_version(),
            **{name: _version(name) for name in ("numpy", "scipy", "h5py")},
        },
        "machine": {
            "platform": platform.platform(),
            "cpu": _cpu_model(),
            "cores": len(cores()),
        },
        "commit": _commit(Path(__file__).resolve().parents[2]),
    }


def _version(package):
    from importlib import metadata

    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def _cpu_model():
    """Name of the processor, which Linux tells in a file of its own."""
    if sys.platform == "linux":
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def _commit(folder):
    """Commit checked out in a folder, "-dirty" added if files differ from it, else None.

    The folder must be the top of the checkout: a package installed into a virtual environment that
    lies inside some other project must not take that project's commit for its own.
    """
    if _git(folder, "rev-parse", "--show-toplevel") != str(folder):
        return None
    # Without the exclusion the nearest tag would stand in place of the commit.
    return _git(folder, "describe", "--always", "--dirty", "--abbrev=40", "--exclude=*")


def _git(folder, *arguments):
    """Answer of a git command, None if there is no git or it failed.

    A process that is forked while MPI runs may spoil its memory. Python starts this one by vfork,
    which copies none of it, and only rank 0 asks.
    """
    try:
        done = subprocess.run(
            ["git", "-C", folder, *arguments], capture_output=True, text=True, check=False
        )
    except OSError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None
