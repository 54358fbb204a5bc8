"""The ranks as a group: the group of one, and how to wait for the others."""

import os
import time

# Ranks on this machine; set by the launchers of MPICH and of Open MPI.
LOCAL_RANKS = ("MPI_LOCALNRANKS", "OMPI_COMM_WORLD_LOCAL_SIZE")
PAUSE = 2e-5  # s


def looks_before_nap(environment):
    """Looks at a message that has not come, each a microsecond, before a nap.

    Who naps comes late, and all who wait for him nap in their turn: so not in the common waits of a
    step.  But who looks keeps a core busy, and where ranks share one the other could not get on.
    """
    ranks = next((int(environment[name]) for name in LOCAL_RANKS if name in environment), 1)
    return 100 if ranks > os.cpu_count() else 30_000


LOOKS = looks_before_nap(os.environ)


class Alone:
    """The communicator of a process without others."""

    rank, size = 0, 1

    def allgather(self, item):
        """What all ranks give, a list."""
        return [item]

    def bcast(self, item):
        """What rank 0 gives."""
        return item

    def Dup(self):
        """Another communicator of the same ranks."""
        return Alone()


def meet(comm):
    """Wait until all ranks are here.

    A rank that waits inside MPI keeps its core busy; where ranks share one, the other rank could
    not get on.
    """
    if comm.size > 1:
        finish([comm.Ibarrier()])


def finish(requests):
    """Wait for requests, and let others have the core if that takes long."""
    spins = 0
    for request in requests:
        while not request.Test():
            spins += 1
            os.sched_yield() if spins < LOOKS else time.sleep(PAUSE)


def all_here(comm, patience=5.0):
    """Whether all ranks come to this place within so many seconds.

    Parameters
    ----------
    comm : communicator
        One that serves for nothing else: the other ranks may be waiting for something else.
    """
    if comm.size == 1:
        return True
    request, end = comm.Ibarrier(), time.monotonic() + patience
    while not request.Test():
        if time.monotonic() > end:
            return False
        time.sleep(PAUSE)
    return True


def on_root(comm, act):
    """Result of `act` on rank 0, None elsewhere; an error there is raised on every rank."""
    result = error = None
    if comm.rank == 0:
        try:
            result = act()
        except Exception as found:
            error = found
    meet(comm)
    error = comm.bcast(error)
    if error is not None:
        raise error
    return result
