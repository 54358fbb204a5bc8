"""Results of a validation that never ran, to draw reports of."""

import json

import numpy as np
from matplotlib.figure import Figure

from validation import report

README = """\
# Standing wave

A wave of the first mode in a closed tank, left to itself. The theory of **potential flow** gives
its period and, with the boundary layers left out, no damping at all.

## Set-up of the tank

| quantity | value |
|---|---|
| length | 0.5 m |
| depth | 0.1 m |

See [Lamb, *Hydrodynamics*](https://en.wikipedia.org/wiki/Hydrodynamics_(book)), and run it with

    python -m mpslab.tank standing_wave --set particles.spacing=0.002
"""


def metric(name, title, unit, low, high, value, known=None, **more):
    met = value is not None and (low is None or value >= low) and (high is None or value <= high)
    reason = "The scatter of three seeds is 0.015, and the bar stands two such below the mean."
    single = {"error": 0.0, "draws": [value], "scatter": 0.0, "scatter_from": ""}
    return {"id": name, "title": title, "unit": unit, "low": low, "high": high, "value": value,
            "verdict": "met" if met else "missed", "reason": reason, "known": known,
            **single, **more}  # fmt: skip


def undecided(known=None):
    """A metric at an edge of its band, the mean of three draws."""
    return metric("loss", "Height lost over five wavelengths", "%", None, 4.0, 3.4, known,
                  verdict="open", error=0.5773, draws=[2.5, 3.0, 4.7], scatter=1.0,
                  scatter_from="Six seeds gave 1.9 to 4.7.")  # fmt: skip


def run(name, case, particles, steps, seconds, outcome="finished", reason=None, **changes):
    changes = {key.replace("__", "."): value for key, value in changes.items()}
    return {"name": name, "case": case, "changes": changes, "particles": particles, "steps": steps,
            "seconds": seconds, "outcome": outcome, "reason": reason}  # fmt: skip


def series(label, style, x, y, y2=None):
    columns = {"x": x, "y": y} | ({} if y2 is None else {"y2": y2})
    return {"label": label, "style": style, **{k: list(map(float, c)) for k, c in columns.items()}}


def result(case, title, question, **parts):
    empty = dict.fromkeys(("runs", "metrics", "figures", "tables", "convergence", "notes"), ())
    provenance = {
        "versions": {"mpslab": "0.1.0", "python": "3.11.2", "numpy": "2.4.6", "scipy": "1.17.1"},
        "machine": {"platform": "Linux-6.1-x86_64", "cpu": "Intel(R) Xeon(R) CPU", "cores": 2},
        "commit": "dd1eca4a5b0f8a3c9e7d1b2f4a6c8e0d1f3b5a79-dirty",
        "date": "2026-11-25T10:00:00+00:00",
        "seconds": 812.0,
    }
    return {"case": case, "title": title, "question": question, "suite": "full", "readme": README,
            **{name: list(part) for name, part in empty.items()}, **parts,
            "provenance": provenance}  # fmt: skip


def standing_wave():
    t = np.linspace(0.0, 2.0, 400)
    wave = np.cos(2 * np.pi * t)
    return result(
        "standing_wave",
        "Standing wave",
        "Does a wave live, and with the right period?",
        runs=[
            run("a01_d4", "standing_wave", 980, 870, 4.2, particles__spacing=0.004),
            run("a01_d2", "standing_wave", 3900, 1750, 31.0, particles__spacing=0.002),
            run("a01_d1", "standing_wave", 15600, 3490, 412.0, particles__spacing=0.001,
                initial__amplitude=0.01),
        ],
        metrics=[
            metric("kept", "First mode kept after two periods", "", 0.85, None, 0.97512),
            metric("period", "Period against linear theory", "", 0.98, 1.02, 1.00712),
            metric("level", "Drift of the mean level", "mm", -0.5, 0.5, -0.24),
        ],
        figures=[
            {"title": "First mode, amplitude 0.1 of the depth", "x": "t/T", "equal": False,
             "y": "amplitude / linear amplitude",
             "series": [
                 series("potential flow ± 5 %", "band", t, 0.95 * wave - 0.03, 0.95 * wave + 0.03),
                 series("mpslab, d0 = 4 mm", "line", t, wave * np.exp(-0.12 * t)),
                 series("mpslab, d0 = 2 mm", "line", t, wave * np.exp(-0.03 * t)),
                 series("linear theory", "dashed", t, wave)]},
            {"title": "Mean level", "x": "t/T", "y": "level [mm]", "equal": False,
             "series": [series("mpslab, d0 = 2 mm", "line", t, 0.24 * t / 2 + 0.02 * wave)]},
        ],
        convergence=[{"title": "Error of the first mode", "spacing": [0.004, 0.002, 0.001],
                      "error": [0.1, 0.031, 0.0095], "order": 1.7}],
        notes=["Three seeds of the jitter differ by 0.015 at most."],
    )  # fmt: skip


def breaker():
    t = np.linspace(0.0, 3.0, 800)
    level = 10 * np.maximum(np.sin(4 * t), -0.6) * np.minimum(t, 1.0)
    noise = np.sin(977 * t) + np.sin(541 * t)
    x = np.linspace(0.0, 1.96, 150)
    return result(
        "plunging_breaker",
        "Plunging breaker",
        "Does the wave break where and when the experiment saw it?",
        runs=[
            run("d4", "plunging_breaker", 9120, 3000, 188.0, particles__spacing=0.004),
            run("d2", "plunging_breaker", 36480, 6012, 4810.0, "failed",
                "particle 12345 left the tank at t = 1.31 s, x = 0.57 m", particles__spacing=0.002),
        ],
        metrics=[
            metric("jet_x", "Place of the first jet", "m", 0.55, 0.60, 0.583),
            metric("jet_t", "Time of the first jet", "s", 1.04, 1.14, 0.925,
                   "The paddle starts without the experiment's delay of 0.15 s."),
            metric("height", "Height of the second wave at the toe", "mm", 18.6, 20.6, None),
            metric("rmse", "RMSE of the level at the toe", "mm", None, 1.5, 1.50004),
        ],
        figures=[
            {"title": "Water level at the toe", "x": "time [s]", "y": "level [mm]", "equal": False,
             "series": [series("experiment", "points", t[::20], level[::20] + 0.4 * noise[::20]),
                        series("mpslab, d0 = 4 mm", "line", t, level)]},
            {"title": "Every reading", "x": "time [s]", "y": "level [mm]", "equal": False,
             "series": [series("experiment", "points", t, level + noise),
                        series("mpslab, d0 = 4 mm", "line", t, level)]},
            {"title": "Surface at t = 1.05 s", "x": "x [m]", "y": "z [m]", "equal": True,
             "series": [series("mpslab", "line", x, 0.2 + 0.03 * np.exp(-(((x - 1) / 0.1) ** 2))),
                        series("bed", "dashed", [0, 0.6, 1.96], [0, 0, 0.24])]},
            {"title": "The jet", "picture": "jet.png"},
        ],
        tables=[{"title": "Errors at the gauges",
                 "columns": ["gauge", "RMSE [mm]", "bias [mm]", "phase [s]", "peak [mm]"],
                 "rows": [["toe", 0.4, -0.1, 0.004, 0.3], ["shoreline", 1.93, 0.42, -0.012, 2.1]]}],
    )  # fmt: skip


def dispersion():
    return result(
        "dispersion",
        "Dispersion relation",
        "Do the wavemakers hold the theory that they are made of?",
        metrics=[
            metric("k", "Largest error of the wave number", "", None, 1e-10, 3.1e-13),
            metric("same", "Bits that differ from run to run", "", 0, 0, 0),
        ],
    )


def made():
    return [standing_wave(), breaker(), dispersion()]


def save(results, folder):
    """Results as JSON files, and the picture that one of them names."""
    for number, found in enumerate(results):
        text = json.dumps(found | {"order": number})
        (folder / f"{found['case']}.json").write_text(text)
    picture = Figure(figsize=(6, 2))
    picture.subplots().plot([0, 1], [1, 0])
    picture.savefig(folder / "jet.png")
    return folder


def written(folder):
    """Results saved in a folder, and their report beside them."""
    report.write(made(), save(made(), folder))
    return folder
