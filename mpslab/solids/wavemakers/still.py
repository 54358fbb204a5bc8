"""A paddle that stays at rest."""

import numpy as np

from mpslab.solids import paddle


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle at rest; uses no key of the wavemaker."""
    return paddle.from_motion(np.zeros_like, np.array([0.0, end]), 0.0, "paddle at rest")
