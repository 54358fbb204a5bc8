"""Move the cuts between ranks as the water moves, and keep account of it."""

import time

import numpy as np

from mpslab import balance

# CPU time that a particle of a wall costs, as a share of one of water (measured: 0.01 to 0.08).
SOLID = 0.05


def load(method, fluid, slab, slabs):
    """Load of each slab, (slabs,), by which a method cuts.

    The paper's "centroid" counts particles.  The others take the work: of rows in the lists and
    in the matrix, which only water has, and a little for each other particle.  It is counted, not
    timed: the fixed cost of a step would make the particles of a rank with few of them look
    expensive, the rank would be given fewer still, and so on.

    Parameters
    ----------
    method : str
    fluid : (n,) bool
    slab : (n,) int32
    slabs : int
        Number of slabs.
    """
    weight = np.ones(len(slab)) if method == "centroid" else np.where(fluid, 1.0, SOLID)
    return np.bincount(slab, weight, minlength=slabs)


class Rebalancer:
    """Cuts anew, and remembers when it last did.

    Parameters
    ----------
    domain : mpslab.domain.Domain
    method : str
        ``parallel.balance``.
    """

    def __init__(self, domain, method):
        self.domain, self.method = domain, method
        self._begin()

    def _begin(self):
        self._cpu, self._waited = time.process_time(), self.domain.waited
        self._migrated = self.domain.migrated

    def cut(self, particles):
        """Choose new cuts; the particles follow with the next step.

        Returns
        -------
        dict
            By the keys of `mpslab.output.DECOMPOSITION_COLUMNS`, without step and time; particles
            and CPU seconds of work since the last cut are lists over the ranks.
        """
        domain = self.domain
        cpu, waited = time.process_time() - self._cpu, domain.waited - self._waited
        mine = (len(particles), cpu - waited, waited, domain.migrated - self._migrated,
                domain.ghosts)  # fmt: skip
        sizes, seconds, waits, migrated, ghosts = zip(*domain.from_all(mine), strict=True)
        work = domain.collect(
            load(self.method, particles.fluid, domain.slab, domain.slabs.count)
        )
        before = balance.imbalance(work, domain.cuts)
        domain.cuts = balance.cut(self.method, work, domain.size)
        self._begin()
        return {
            "particles": list(sizes),
            "seconds": [round(s, 4) for s in seconds],
            "waiting": [round(s, 4) for s in waits],
            "imbalance_before": before,
            "imbalance_after": balance.imbalance(work, domain.cuts),
            "migrated": sum(migrated),
            "ghosts": sum(ghosts),
        }
