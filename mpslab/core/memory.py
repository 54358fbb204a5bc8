"""The memory of the machine, and freed memory kept: every step asks for the same arrays again."""

import ctypes
import os

# Parameters of mallopt (malloc.h of the GNU C library), and the largest values they take.
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3
NEVER, LARGEST = 2**31 - 1, 2**25


def keep_freed():
    """Tell the C library to keep freed memory; without glibc this does nothing.

    A step makes and drops many arrays.  The system fills pages that are fetched anew with zeros:
    this takes 4 % of a step in 3-D with 64,000 particles of water.
    """
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (OSError, AttributeError):
        return
    mallopt(M_TRIM_THRESHOLD, NEVER)
    mallopt(M_MMAP_THRESHOLD, LARGEST)


def physical():
    """Memory of this machine [bytes], 0 where the system does not say."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, AttributeError):
        return 0
