"""The memory of the machine, and freed memory kept: every step asks for the same arrays again."""

import ctypes
import os

# Parameters of mallopt (malloc.h of the GNU C library), and the largest values they take.
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3
NEVER, LARGEST = 2**31 - 1, 2**25


def keep_freed():
    """Tell the C library not to hand freed memory back to the system; nothing without glibc.

    A step makes and drops many arrays.  Fetched anew, their pages are filled with zeros by the
    system first: 4 % of a step in 3-D, 64,000 particles of water.
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
