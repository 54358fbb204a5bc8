"""Seas that were drawn, not computed: surface elevations of known spectra and reflection, and run
folders that hold them.
"""

import numpy as np
from tanks import make_case

from mpslab.cases.writer import dumps
from mpslab.theory.waves import wave_number

GRAVITY = 9.81


def jonswap(f, height, period, gamma=3.3):
    """Density of JONSWAP at frequencies (n,) [m2 s]; 4 sqrt(m0) is the height over them."""
    peak = 1.0 / period
    width = np.where(f <= peak, 0.07, 0.09)
    shape = f**-5.0 * np.exp(-1.25 * (peak / f) ** 4)
    shape *= gamma ** np.exp(-0.5 * ((f / peak - 1.0) / width) ** 2)
    return shape * (height / 4.0) ** 2 / np.sum(shape * np.gradient(f))


def sea(x, count, step, height, period, depth, kr=0.0, wall=0.0, seed=0, repeats=1.0):
    """Elevation of a JONSWAP sea and of what comes back of it from x = wall, (count, gauges) [m].

    `height` is 4 sqrt(m0) of the incident waves. They repeat themselves after `repeats` times the
    record: with 1 it has their variance exactly, with 1.3 it holds whole periods of none.
    """
    whole = round(repeats * count)
    f = np.fft.rfftfreq(whole, step)
    part = (f > 0.5 / period) & (f < 4.0 / period)
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, len(f))[part]
    size = np.sqrt(2.0 * jonswap(f[part], height, period) * f[1]) * np.exp(1j * phase)
    k = np.array([wave_number(1.0 / one, depth, GRAVITY) for one in f[part]])
    columns = []
    for place in np.atleast_1d(x):
        waves = np.zeros(len(f), complex)
        waves[part] = size * np.exp(-1j * k * place)
        waves[part] += kr * size * np.exp(1j * k * (place - 2.0 * wall))
        columns.append(np.fft.irfft(0.5 * whole * waves, whole)[:count])
    return np.stack(columns, axis=1)


def write_run(folder, time, elevation, x, depth, changes=None, names=None):
    """A run folder with a case and the readings of its gauges, elevation (n, gauges) [m]."""
    names = names or [f"g{k + 1}" for k in range(len(x))]
    gauges = [{"name": name, "x": float(place)} for name, place in zip(names, x, strict=True)]
    tables = {
        "tank.length": 1.1 * float(max(x)) + 5.0, "tank.depth": depth, "gauge": gauges,
        "particles.spacing": depth / 20.0, "time.end": float(time[-1]) if len(time) else 1.0,
        **(changes or {}),
    }  # fmt: skip
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.toml").write_text(dumps(make_case(tables)))
    rows = [",".join(["time [s]", *(f"{name} [m]" for name in names)])]
    rows += [
        ",".join(map(repr, [float(t), *(float(depth + e) for e in row)]))
        for t, row in zip(time, elevation, strict=True)
    ]
    (folder / "gauges.csv").write_text("\n".join(rows) + "\n")
    return folder
