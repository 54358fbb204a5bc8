"""Checks of the free bodies of a case, and of their moorings."""

import numpy as np

from mpslab.core.keys import require, require_choice, shown
from mpslab.core.plugins import load
from mpslab.core.structures import MODES
from mpslab.instruments import check_names
from mpslab.solids.collection import solids_of
from mpslab.solids.contact import APART, Contact
from mpslab.solids.floating import FLAT, weigh
from mpslab.solids.shaped import place_of

OWN = ("density", "mass", "center_of_mass", "inertia", "locked", "velocity", "release")
STIFFEST = 0.5  # of a line: its frequency times the largest step


def check_bodies(case):
    """Raise CaseError, with key, value and range, if a free body or its mooring cannot be."""
    free = [i for i, given in enumerate(case.solid) if given.motion == "free"]
    for i, given in enumerate(case.solid):
        _check_own(case, f"solid.{i}", given) if i in free else _check_none(f"solid.{i}", given)
    if free:
        _check_scheme(case)
        _check_room(case, free)
    _check_moorings(case, {case.solid[i].name: i for i in free})


def _check_none(where, given):
    plain = type(given).__dataclass_fields__
    for name in OWN:
        value = getattr(given, name)
        rule = "left out unless motion = 'free'"
        require(value == plain[name].default, f"{where}.{name}", value, rule)


def _check_own(case, where, given):
    rule = "> 0, or mass given, for motion = 'free'"
    require(given.density > 0.0 or given.mass > 0.0, f"{where}.density", given.density, rule)
    both = given.density > 0.0 and given.mass > 0.0
    require(not both, f"{where}.mass", given.mass, "0 where density is given")
    modes = FLAT if case.dim == 2 else MODES
    fits = set(given.locked) <= set(modes)
    rule = f"out of {', '.join(modes)} in a 2-D tank"
    require(fits, f"{where}.locked", list(given.locked), rule)
    rule = "such that one way to move is left, or motion = 'none'"
    require(len(given.locked) < len(modes), f"{where}.locked", list(given.locked), rule)
    count, what = (1, "one number, Iyy,") if case.dim == 2 else (3, "three, Ixx, Iyy and Izz,")
    rule = f"{what} or left out"
    require(len(given.inertia) in (0, count), f"{where}.inertia", list(given.inertia), rule)
    still = given.release == 0.0 or not any(given.velocity)
    rule = "[0.0, 0.0, 0.0] with a release, until which the body is held"
    require(still, f"{where}.velocity", list(given.velocity), rule)
    if case.dim == 3 and given.shape in ("polygon", "cylinder"):
        rule = "given for a free polygon or cylinder in a tank with width"
        require(given.ends is not None, f"{where}.ends", given.ends, rule)


def _check_scheme(case):
    scheme, frame = case.scheme, case.frame.type
    for name, value in (("walls", "extrapolated"), ("projection", "start")):
        rule = f"{value!r} with a free body, whose acceleration the pressure has to know"
        require(getattr(scheme, name) == value, f"scheme.{name}", getattr(scheme, name), rule)
    rule = "one whose pair forces are equal and opposite, with a free body"
    conserves = load("gradients", scheme.gradient).CONSERVES_MOMENTUM
    require(conserves, "scheme.gradient", scheme.gradient, rule)
    rule = "none, sway or heave with a free body: in a tank that turns its inertia is not known"
    require(frame in ("none", "sway", "heave"), "frame.type", frame, rule)


def _check_room(case, free):
    """Refuse bodies that are laid out in contact with something."""
    for i, gaps in zip(free, gaps_of(case), strict=True):
        least = APART * case.particles.spacing
        given, place = case.solid[i], place_of(case.solid[i])
        for name, gap in gaps.items():
            rule = f"{least:g} m, a spacing, or more off the {name}; here it is {shown(gap)} m"
            fits = gap >= least * (1.0 - 1e-6)
            require(fits, f"solid.{i}.{place}", getattr(given, place), rule)


def gaps_of(case):
    """How far each free body, as laid out, is from the tank and other solids, a list of dicts of
    name to [m], to the micrometre.
    """
    solids = solids_of(case)
    contact = Contact(case, solids, solids.free)
    return [
        {name: round(gap, 6) for name, gap in contact.gaps(k, 0.0)} for k in range(len(solids.free))
    ]


def _check_moorings(case, bodies):
    check_names("mooring", case.mooring)
    step = case.time.maximum
    for i, given in enumerate(case.mooring):
        where = f"mooring.{i}"
        require(bool(bodies), where, given.on, "left out where no solid has motion = 'free'")
        require_choice(f"{where}.on", given.on, bodies)
        mass = weigh(case, bodies[given.on])[0]
        most = mass * (STIFFEST / step) ** 2 if step else np.inf
        rule = f"<= {most:.4g} N/m: a stiffer line swings faster than steps of {step:.3g} s follow"
        require(given.stiffness <= most, f"{where}.stiffness", given.stiffness, rule)
        most = mass * STIFFEST / step if step else np.inf
        rule = f"<= {most:.4g} N s/m: more would turn the body round within steps of {step:.3g} s"
        require(given.damping <= most, f"{where}.damping", given.damping, rule)
