"""Profiles of a dam break on a wet bed against a film."""

from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from mpslab.overturning import find_crest
from mpslab.particles import FLUID
from validation.comparison import Comparison

DATA = Path(__file__).parent / "data" / "spheric5_janosi_d38mm_profiles.csv"
STILL = 0.038  # [m] level of the layer
FAR = 0.25  # [m] at the end of a profile that is undisturbed, where it has such an end
RAISED = 0.010  # [m] above the still level: disturbed
LONGEST = 0.15  # [s] a shift in time
SHOWN = (0.219, 0.343, 0.468)  # seconds


def compare(runs):
    """Distance of the profiles, front and jet, of the finest run, shifted in time."""
    result = Comparison()
    film, rows = _film(), []
    for name, run in runs.items():
        distances, fronts, jets = [], [], 0
        shift = _shift(run, film)
        for time, profile in film.items():
            _, frame = run.frame_at(time - shift)
            wet, surface = frame["kind"] == FLUID, _surface(frame, run.spacing)
            distance = cKDTree(surface).query(profile)[0]
            distances.append(np.sqrt(np.mean(distance**2)))
            fronts.append(_foremost(surface) - _foremost(profile))
            x, z = frame["position"][wet, 0], frame["position"][wet, 2]
            speed = np.linalg.norm(frame["velocity"][wet], axis=1)
            jets += find_crest(x, z, speed, run.spacing).overturns
            rows.append([name, time, shift, 1e3 * distances[-1], 1e3 * fronts[-1]])
            if run is list(runs.values())[-1] and time in SHOWN:
                figure = result.figure(f"Surface at t = {time:g} s", "x [m]", "z [m]", equal=True)
                figure.points(f"standard, d0 = {1e3 * run.spacing:.2g} mm", *surface.T)
                figure.dashed("film", *profile.T)
    result.measure("shift", 1e3 * shift)
    result.measure("profiles", 1e3 * np.mean(distances))
    result.measure("front", 1e3 * np.sqrt(np.nanmean(np.square(fronts))))
    result.measure("jet", jets)
    columns = [
        "run",
        "time of the film [s]",
        "simulation early by [s]",
        "rms distance [mm]",
        "front ahead [mm]",
    ]
    result.table("Frame by frame", columns, rows)
    return result


def _shift(run, film):
    """How much earlier the simulation is than the film [s]: the least distance of the profiles."""

    def distance(shift):
        found = 0.0
        for time, profile in film.items():
            surface = _surface(run.frame_at(time - shift)[1], run.spacing)
            found += np.mean(cKDTree(surface).query(profile)[0] ** 2)
        return found

    return min(np.arange(0.0, LONGEST, run.case["output"]["interval"]), key=distance)


def _film():
    """Profiles by time: (n, 2) x and z [m], with the undisturbed level at 38 mm."""
    table = np.loadtxt(DATA, delimiter=",", skiprows=1)
    film, shift = {}, 0.0
    for time in np.unique(table[:, 0]):
        x, z = table[table[:, 0] == time][:, 2:4].T
        far = x > x.max() - FAR
        if np.ptp(z[far]) < RAISED:
            shift = STILL - z[far].mean()
        film[float(time)] = np.column_stack([x, z + shift])
    return film


def _surface(frame, spacing):
    """Surface particles, moved half a spacing up: (n, 2) x and z [m]."""
    top = (frame["kind"] == FLUID) & (frame["surface"] == 1)
    x, _, z = frame["position"][top].astype(float).T
    return np.column_stack([x, z + 0.5 * spacing])


def _foremost(surface):
    """x [m] of the foremost point that is clearly above the still level."""
    raised = surface[surface[:, 1] > STILL + RAISED, 0]
    return raised.max() if len(raised) else np.nan
