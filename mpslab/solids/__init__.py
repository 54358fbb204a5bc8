"""Solids: the tank, and what stands in it or moves through it.

A solid is an object with

    name : str
    particles(case) -> position (n, 3) float64 [m], role (n,) int8
        Where its particles stand at t = 0, and whether each is a FACE, which carries a pressure,
        or a FILLER behind it. Two faces that both meet water stand as far apart as
        `obstacles.least_thickness` says.
    motion : function (t [s]) -> (x, z, angle) [m, m, rad], or None
        How far it has gone from where it was laid out (`mpslab.core.motion`); None for a solid
        that stands still. Of a body that the water moves (`mpslab.solids.floating`), how far it has
        gone by now.
    holds(points) -> (n,) bool
        Which places (n, 3) [m] are inside it, as it was laid out: no water is laid there.
    state() -> dict, restore(dict)
        What a checkpoint keeps of it: names to numbers, strings and arrays.

`mpslab.solids.solid.Solid` has all of these but the first two, for a solid that keeps nothing, and
what a run calls: `begin`, `advance`, `push` and `move`.

In a step the velocity of a solid is that of its whole move in this step, move/dt, and its
acceleration is the change of this velocity since the step before. So solid and water, which the
pressure keeps apart, agree on where they are at the end. All through the step, therefore, a solid
has the velocity of the step, and with projection "start" still the place of its beginning.
"""
