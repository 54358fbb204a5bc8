"""Piston for an irregular sea from a spectrum, to first or second order (Schaffer 1996)."""

import numpy as np

from mpslab.solids import paddle
from mpslab.solids.wavemakers import _sea, _table
from mpslab.theory import breaking, waves

SHORTEST_RISE = 0.5  # peak periods: the motion has no beginning of its own


def make(wavemaker, depth: float, gravity: float, end: float) -> paddle.Paddle:
    """Paddle X = Re sum of -i A / c0 e^{i omega t}, c0 of Biesel; order 2 adds what Schaffer says.

    The frequencies are multiples of 1 / wavemaker.record within wavemaker.band; the phases are
    random, from wavemaker.seed. For each frequency |A|^2 / 2 = S df; with wavemaker.amplitudes =
    "random" this holds in the mean only: cosine and sine are then Gaussian (Tucker et al. 1984).
    The motion is faded in within wavemaker.start, or half a peak period where that is longer.

    Raises ValueError as `_sea.of_wavemaker` and `_sea.require_range` do, or if a stroke is given.
    """
    paddle.refuse_stroke(wavemaker)
    sea = _sea.of_wavemaker(wavemaker, depth, gravity, wavemaker.record)
    doubts = _sea.require_range(wavemaker, sea, depth, gravity)
    amplitude = draw(sea, wavemaker.amplitudes, wavemaker.seed)
    table = _sea.piston(sea, amplitude, wavemaker.order, depth, gravity)
    record, fade = sea.record, max(wavemaker.start, SHORTEST_RISE * sea.period)
    motion = _table.Faded(table, fade)
    times = _sea.samples_of(table, min(end, fade + record))
    facts = _sea.facts_of(sea, amplitude, motion, times, depth, gravity)
    heights = _sea.waves_of(_sea.surface(sea, amplitude), min(end, record))
    drawn = 4.0 * np.sqrt(0.5 * np.sum(np.abs(amplitude) ** 2))
    facts |= {"significant_height [m]": float(drawn), "waves": len(heights)}
    if len(heights):
        facts["largest_height [m]"] = float(heights.max())
        doubts += _breaking(sea, heights.max(), depth, gravity)
    if end > record:
        doubts.append(f"wavemaker.record = {record:g} s: the sea comes again before time.end = "
                      f"{end:g} s")  # fmt: skip
    whole = _sea.samples_of(table, fade + record)
    note = (
        f"irregular sea, {wavemaker.spectrum}, order {wavemaker.order}: {len(amplitude)} components"
        f" {1.0 / record:.4g} Hz apart, {100 * sea.left_out:.1f} % of the spectrum left out and "
        "made up for"
    )
    return paddle.from_motion(
        motion, times, sea.height, note, whole, facts, (*doubts, *_sea.doubts_of(sea)),
        (sea.rate, np.abs(amplitude)), _sea.beyond(sea, amplitude, motion, depth, gravity),
    )  # fmt: skip


def draw(sea, kind, seed):
    """Complex amplitudes of the components [m], (n,) complex128, from a seed.

    kind "deterministic": |A| = sqrt(2 S df) and a random phase; "random": Gaussian parts.
    """
    draws = np.random.default_rng(seed)
    count = len(sea.variance)
    if kind == "random":
        cosine, sine = draws.standard_normal((2, count))
        return np.sqrt(sea.variance) * (cosine + 1j * sine)
    return np.sqrt(2.0 * sea.variance) * np.exp(2j * np.pi * draws.random(count))


def _breaking(sea, largest, depth, gravity):
    limit = breaking.miche_height(waves.wavelength(sea.period, depth, gravity), depth)
    if largest < limit:
        return []
    return [
        f"wavemaker.height = {sea.height:g} m: the highest wave of the run, {largest:.3g} m, would "
        f"be higher than {limit:.3g} m, 0.142 L tanh(kh) of the peak: it breaks at the maker"
    ]
