"""What launchers say of the processes they start.

If its launcher says that a process is one of several, and its MPI that it is alone, then the
launcher is that of another MPI, or knows no MPI. Then each process would run the whole tank, and
all of them into the same folder.
"""

# Variables with the number of ranks: of Open MPI, MVAPICH, and MPICH and its relatives.
SIZES = ("OMPI_COMM_WORLD_SIZE", "MV2_COMM_WORLD_SIZE", "PMI_SIZE")
# With the number of ranks on this machine, which may not be all of them.
LOCAL_SIZES = ("MPI_LOCALNRANKS", "OMPI_COMM_WORLD_LOCAL_SIZE", "MV2_COMM_WORLD_LOCAL_SIZE")
# Slurm's step numbers from here on stand for the script, or the shell, of a job, not for a step of
# srun.
SLURM_SCRIPTS = 0xFFFFFFF0


def told(environment):
    """What the environment says of the number of ranks.

    Returns
    -------
    (str, int, bool) or None
        The variable, the number, and whether there may be more; None where no launcher has started
        this process.
    """
    for name in SIZES:
        if _number(environment, name):
            return name, _number(environment, name), False
    for name in LOCAL_SIZES:
        if _number(environment, name):
            return name, _number(environment, name), True
    name, tasks = _slurm(environment)
    if tasks > 1:
        return name, tasks, False
    if "PMIX_RANK" in environment:
        return "PMIX_RANK", _number(environment, "PMIX_RANK") + 1, True
    return None


def _slurm(environment):
    """Tasks of a step of srun and the variable that says so; 0 outside of one.

    SLURM_NTASKS by itself is what a job has asked for, which its script and shell see as well.
    """
    step = "SLURM_STEP_ID" if "SLURM_STEP_ID" in environment else "SLURM_STEPID"
    started = "SLURM_PROCID" in environment and environment.get(step, "").isdigit()
    if not started or int(environment[step]) >= SLURM_SCRIPTS:
        return "", 0
    name = next((n for n in ("SLURM_STEP_NUM_TASKS", "SLURM_NTASKS") if n in environment), "")
    return name, _number(environment, name)


def _number(environment, name):
    """A variable as a whole number, 0 where it is none."""
    value = environment.get(name, "")
    return int(value) if value.isdigit() else 0


def claim(environment):
    """What a launcher claims, as the beginning of an error message."""
    name, ranks, or_more = told(environment)
    more = " or more" if or_more else ""
    return f"{name} = {environment[name]}: the launcher has started {ranks} processes{more}"


def check(environment, size):
    """Raise ValueError unless MPI's number of ranks is that of the launcher."""
    _, ranks, or_more = told(environment)
    if size == ranks or (or_more and size > ranks):
        return
    raise ValueError(
        f"{claim(environment)}, but MPI joins {size}, so that each would run the whole tank; must "
        f"be the same: start with --ranks {ranks}, or with the mpiexec of the MPI in use here "
        "(srun: with --mpi=pmi2, if that MPI knows it)"
    )
