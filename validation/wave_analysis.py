"""What a wave loses along the tank."""

import numpy as np


def decay(x, amplitude):
    """Rate b [1/m] of the fit A exp(-b x) to amplitudes (n,) at places x (n,) [m].

    Returns
    -------
    (3,) float64
        The rate b, A, and the standard error of b.
    """
    (slope, intercept), covariance = np.polyfit(x, np.log(amplitude), 1, cov=True)
    return np.array([-slope, np.exp(intercept), np.sqrt(covariance[0, 0])])
