"""The heading of a picture: the case, and the models and the resolution that it was run with."""

import textwrap
from dataclasses import fields
from pathlib import Path

from mpslab.cases.recipes import RECIPES
from mpslab.core.scheme import Scheme

# A picture does not depend on these, except for rounding.
UNSEEN = ("recipe", "solver", "tolerance", "max_iterations")


def heading(case, text, width=100):
    """Lines over a picture of a run.

    Parameters
    ----------
    case : dict
        The resolved case as its TOML file holds it.
    text : str
        What the picture shows.
    width : int
        Characters in a line.

    Returns
    -------
    str
        Name and title; dimensions, particle spacing, wave and models; and the text.
    """
    title = f"{case['name']}: {case['title']}" if case.get("title") else case["name"]
    setting = [part for part in (_resolution(case), wave(case)) if part]
    together = "; ".join([*setting, models(case)])
    settings = [together] if len(together) <= width else ["; ".join(setting), models(case)]
    return "\n".join(textwrap.fill(line, width) for line in (title, *settings, text))


def _resolution(case):
    """Dimensions and particle spacing."""
    spacing, depth = case["particles"]["spacing"], case["tank"]["depth"]
    dimensions = "3-D" if case["tank"]["width"] else "2-D"
    return f"{dimensions}, $d_0$ = {_mm(spacing)} ({depth / spacing:.3g} over the depth)"


def wave(case):
    """The wave that is made, or that is there at the start, in words; empty if there is none."""
    maker, initial = case["wavemaker"], case["initial"]
    if initial["type"] == "standing_wave":
        return f"standing wave, a = {_mm(initial['amplitude'])}"
    if initial["type"] == "stream":
        return f"stream of {initial['speed']:.3g} m/s"
    if initial["type"] in ("strain", "rotation"):
        return f"{initial['type']} of {initial['rate']:.3g} 1/s"
    if maker["type"] in ("none", "still"):
        return ""
    if maker["type"] == "file":
        return f"piston after {Path(maker['file']).name}"
    parts = {"H": maker["height"], "stroke": maker["stroke"]}
    said = [f"{name} = {_mm(size)}" for name, size in parts.items() if size]
    said += [f"T = {maker['period']:.4g} s"] if maker["period"] else []
    return f"{maker['type'].replace('_', ' ')} wave, {', '.join(said)}"


def _mm(length):
    return f"{1e3 * length:.3g} mm"


def models(case):
    """The recipe, and the keys of the scheme that differ from it."""
    scheme = case["scheme"]
    named = {item.name: item.default for item in fields(Scheme)} | RECIPES.get(scheme["recipe"], {})
    other = [
        f"{name} {_said(scheme[name])}"
        for name, value in named.items()
        if name not in UNSEEN and name in scheme and not _same(scheme[name], value)
    ]
    return f"recipe {scheme['recipe']}" + (f" with {', '.join(other)}" if other else "")


def _same(one, other):
    return list(one) == list(other) if isinstance(one, list | tuple) else one == other


def _said(value):
    if isinstance(value, list):
        return " + ".join(value) or "none"
    return str(value).lower() if isinstance(value, bool) else str(value)
