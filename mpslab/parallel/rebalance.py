"""Move the cuts between ranks as the water moves, and keep account of it."""

import numpy as np

from mpslab.core.stopwatch import COMMUNICATION, WAITING, WORK
from mpslab.parallel import balance

# CPU time that a particle of a wall costs, as a share of one of water (measured: 0.01 to 0.08).
SOLID = 0.05


def load(method, fluid, slab, slabs):
    """Load of each slab, (slabs,), by which a method chooses its cuts.

    The paper's "centroid" counts particles.  The others count the work: that for the rows of the
    lists and of the matrix, which only water has, and a little for each other particle.  It is
    counted, not timed: a step has a fixed cost, so that the particles of a rank with few of them
    would look expensive; the rank would be given fewer still, and so on.

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
    """Makes new cuts, and remembers when it last did.

    Parameters
    ----------
    domain : mpslab.parallel.domain.Domain
    method : str
        ``parallel.balance``.
    """

    def __init__(self, domain, method):
        self.domain, self.method = domain, method
        self._migrated = domain.migrated

    def cut(self, particles, laps):
        """Choose new cuts; the particles follow with the next step.

        Parameters
        ----------
        particles : ParticleSet, without ghosts
        laps : list of dict
            `mpslab.core.stopwatch.Stopwatch.lap` of each rank since the last cut.

        Returns
        -------
        dict
            By the keys of `mpslab.core.columns.DECOMPOSITION_COLUMNS`, without step and time;
            particles and seconds of work and of all else since the last cut are lists over the
            ranks.
        """
        domain = self.domain
        mine = len(particles), domain.migrated - self._migrated, domain.ghosts
        sizes, migrated, ghosts = zip(*domain.from_all(mine), strict=True)

        def loads(method):
            return domain.collect(
                load(method, particles.fluid, domain.slab, domain.slabs.count)
            )

        # The imbalance is that of the work, whatever the method goes by.
        work = loads("optimal")
        share = loads("centroid") if self.method == "centroid" else work
        before = balance.imbalance(work, domain.cuts)
        domain.cuts = balance.cut(self.method, share, domain.size)
        self._migrated = domain.migrated
        return {
            "particles": list(sizes),
            "seconds": [_seconds(lap, WORK) for lap in laps],
            "waiting": [_seconds(lap, COMMUNICATION, WAITING) for lap in laps],
            "imbalance_before": before,
            "imbalance_after": balance.imbalance(work, domain.cuts),
            "migrated": sum(migrated),
            "ghosts": sum(ghosts),
        }


def _seconds(lap, *kinds):
    """Seconds of some kinds in all phases, to a tenth of a millisecond."""
    return round(sum(s for (_, kind), s in lap.items() if kind in kinds), 4)
