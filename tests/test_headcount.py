"""Launchers: what they say of their processes is held against what MPI knows."""

import os
import subprocess
import sys

import pytest
from ranks import ROOT, SMALL, TIMEOUT, environment

from mpslab.parallel import headcount

STEP = {"SLURM_PROCID": "1", "SLURM_STEP_ID": "0", "SLURM_NTASKS": "4"}
BATCH = {"SLURM_JOB_ID": "9", "SLURM_NTASKS": "4", "SLURM_NPROCS": "4", "SLURM_PROCID": "0"}
TOLD = {
    "none": ({}, None),
    "MPICH": ({"PMI_SIZE": "4", "MPI_LOCALNRANKS": "2"}, ("PMI_SIZE", 4, False)),
    "Open MPI": ({"OMPI_COMM_WORLD_SIZE": "3", "PMIX_RANK": "0"},
                 ("OMPI_COMM_WORLD_SIZE", 3, False)),
    "MVAPICH": ({"MV2_COMM_WORLD_SIZE": "2"}, ("MV2_COMM_WORLD_SIZE", 2, False)),
    "ranks of this machine": ({"MPI_LOCALNRANKS": "2"}, ("MPI_LOCALNRANKS", 2, True)),
    "PMIx": ({"PMIX_RANK": "2"}, ("PMIX_RANK", 3, True)),
    "srun": ({**STEP, "SLURM_STEP_NUM_TASKS": "2"}, ("SLURM_STEP_NUM_TASKS", 2, False)),
    "srun of old": (STEP, ("SLURM_NTASKS", 4, False)),
    "srun with PMIx": ({**STEP, "PMIX_RANK": "1"}, ("SLURM_NTASKS", 4, False)),
    "srun of one task": ({**STEP, "SLURM_NTASKS": "1"}, None),
    "one task in a larger job": ({**STEP, "SLURM_STEP_NUM_TASKS": "1"}, None),
    "mpiexec whose proxies srun started": (
        {**STEP, "SLURM_STEP_NUM_TASKS": "2", "PMI_SIZE": "8"}, ("PMI_SIZE", 8, False)
    ),
    "salloc": ({"SLURM_JOB_ID": "9", "SLURM_NTASKS": "4"}, None),
    "sbatch": (BATCH, None),
    "sbatch that counts its script": ({**BATCH, "SLURM_STEP_ID": "4294967291"}, None),
    "salloc with a step for the shell": ({**BATCH, "SLURM_STEP_ID": "4294967290"}, None),
    "not a number": ({"PMI_SIZE": "many"}, None),
}  # fmt: skip


@pytest.mark.parametrize("variables, expected", TOLD.values(), ids=TOLD)
def test_number_of_ranks_is_read_from_the_environment(variables, expected):
    assert headcount.told(variables) == expected


def test_number_of_ranks_of_mpi_has_to_fit():
    headcount.check({"PMI_SIZE": "4"}, 4)
    headcount.check({"MPI_LOCALNRANKS": "2"}, 6)
    for variables, size in (({"PMI_SIZE": "4"}, 1), ({"MPI_LOCALNRANKS": "2"}, 1),
                            ({"OMPI_COMM_WORLD_SIZE": "2"}, 4)):  # fmt: skip
        with pytest.raises(ValueError, match="must be the same") as caught:
            headcount.check(variables, size)
        assert "\n" not in str(caught.value)


def command(out, variables, *before):
    """The command line in a process with some variables, of no launcher but these."""
    clean = {k: v for k, v in environment().items() if not k.startswith(("SLURM", "PMI", "OMPI"))}
    line = [sys.executable, *before, *SMALL, "--until", "0.001", "--no-pictures", "--out", str(out)]
    return subprocess.run(line, env={**clean, **variables}, cwd=ROOT, timeout=TIMEOUT,
                          capture_output=True, text=True)  # fmt: skip


def said(error):
    """The lines of mpslab; mpi4py may add a warning of its own."""
    return [line for line in error.splitlines() if line.startswith("mpslab: ")]


@pytest.mark.parametrize(
    "variables",
    [{"OMPI_COMM_WORLD_SIZE": "4"}, {"PMI_SIZE": "4", "PMI_RANK": "1"},
     {**STEP, "SLURM_STEP_NUM_TASKS": "4"}],
)  # fmt: skip
def test_lone_copy_is_refused_with_the_cure_and_writes_nothing(tmp_path, variables):
    done = command(tmp_path / "run", variables, "-m", "mpslab.tank")
    assert done.returncode == 2, done.stderr
    (line,) = said(done.stderr)
    assert " = 4: the launcher has started 4 processes" in line
    assert "--ranks 4" in line and "MPI joins 1" in line
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("variables", [BATCH, {**STEP, "SLURM_STEP_NUM_TASKS": "1"}])
def test_plain_run_in_a_job_of_slurm_goes_on(tmp_path, variables):
    done = command(tmp_path / "run", variables, "-m", "mpslab.tank")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "run/run.json").exists()


def test_launcher_without_mpi4py_is_one_line(tmp_path):
    hide = ("import sys; sys.modules['mpi4py'] = None; "
            "from mpslab import tank; sys.exit(tank.main(sys.argv[1:]))")  # fmt: skip
    done = command(tmp_path / "run", {"PMI_SIZE": "2", "PMI_RANK": "0"}, "-c", hide)
    assert done.returncode == 2, done.stderr
    assert done.stderr.count("\n") == 1
    assert "PMI_SIZE = 2" in done.stderr and "pip install mpi4py" in done.stderr
    assert not (tmp_path / "run").exists()


def test_this_process_has_no_launcher():
    assert headcount.told(os.environ) is None
