"""The ranks as a group: a group of one, which ranks share cores, and how to wait for the others."""

import os
import platform
import time

PAUSE = 2e-5  # s


def cores():
    """Numbers of the cores that this process may run on, a set."""
    if hasattr(os, "sched_getaffinity"):
        return os.sched_getaffinity(0)
    return set(range(os.cpu_count() or 1))


def looks_before_nap(ranks, cores):
    """How often to look for a message, a microsecond each time, before the rank sleeps.

    A rank that sleeps wakes late, and then all ranks that wait for it sleep in their turn: so none
    should sleep in the usual waits of a step.  But a rank that looks keeps its core busy, and where
    ranks share a core the other one could not get on.

    Parameters
    ----------
    ranks, cores : int
        Of this machine, and those that its ranks may run on.
    """
    return 100 if ranks > cores else 30_000


class Patience:
    """How often to look before sleeping; `find` sets it, for all ranks together."""

    looks = looks_before_nap(1, 1)

    @classmethod
    def find(cls, comm):
        """Count the ranks on this machine, and the cores that any of them may run on."""
        here = platform.node()
        found = [theirs for place, theirs in comm.allgather((here, cores())) if place == here]
        cls.looks = looks_before_nap(len(found), len(set.union(*found)))


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
            os.sched_yield() if spins < Patience.looks else time.sleep(PAUSE)


def all_here(comm, patience=5.0):
    """Whether all ranks come to this place within so many seconds.

    Parameters
    ----------
    comm : communicator
        One that is used for nothing else, as the other ranks may be in the middle of something.
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
