"""The package starts quickly: what only some work needs is loaded by that work."""

import subprocess
import sys

import pytest

HEAVY = {
    "scipy",
    "Cython",
    "matplotlib",
    "h5py",
    "rich",
    "mpi4py",
}


@pytest.mark.parametrize(
    "act",
    ["import mpslab", "import mpslab.tank", "from mpslab import tank; tank.main(['--list'])"],
)
def test_nothing_heavy_is_loaded_before_it_is_needed(act):
    script = f"import sys; {act}; print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert HEAVY & set(done.stderr.split()) == set()
