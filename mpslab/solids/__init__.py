"""Solids: the tank, and what stands in it or moves through it.

A solid is an object with

    name : str
    particles(case) -> position (n, 3) float64 [m], role (n,) int8
        Where its particles stand at t = 0, and whether each is a FACE, which carries a pressure,
        or a FILLER behind it. Two faces that both meet water stand as far apart as
        `obstacles.least_thickness` says.
    motion : function (t [s], derivative=0) -> (x, z, angle) [m, m, rad], or None
        None for a solid that stands still. Otherwise how far it has gone from where it was laid
        out, or how fast it goes, or its acceleration (`mpslab.solids.motion`).
    holds(points) -> (n,) bool
        Which places (n, 3) [m] are inside it, as it was laid out: no water is laid there.
    state() -> dict, restore(dict)
        What a checkpoint keeps of it: names to numbers, strings and arrays.

`mpslab.solids.solid.Solid` has all of these but the first two, for a solid that keeps nothing.
"""
