"""The package starts quickly: what only some work needs is loaded by that work."""

import subprocess
import sys

import pytest

import mpslab

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
    assert HEAVY & loaded_by(act) == set()


def loaded_by(act):
    """Names of the modules that a program has loaded at its end, a set."""
    script = f"import sys; {act}; print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return set(done.stderr.split())


def test_the_front_door_loads_what_it_is_asked_for_and_no_more():
    assert "numpy" not in loaded_by("import mpslab")
    of_a_case = loaded_by("import mpslab; mpslab.load_case")
    assert "mpslab.cases.library" in of_a_case
    assert {"mpslab.simulation", "mpslab.analysis.results"} & of_a_case == set()


def test_a_list_of_cases_loads_nothing_that_runs_them():
    loaded = loaded_by("from mpslab import tank; tank.main(['--list'])")
    assert {"mpslab.simulation", "mpslab.cases.checks", "mpslab.run.step"} & loaded == set()


def test_the_front_door_has_all_that_it_says_and_nothing_else():
    for name in mpslab.__all__:
        assert getattr(mpslab, name) is getattr(mpslab, name)
        assert name in dir(mpslab)
    assert mpslab.core.keys.CaseError is mpslab.CaseError
    with pytest.raises(AttributeError, match="'mpslab' has no attribute 'simulator'"):
        mpslab.simulator  # noqa: B018
