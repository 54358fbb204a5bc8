"""Wavemakers: each module holds one, `make(wavemaker, depth, gravity, end) -> Paddle`.

`wavemaker` has the attributes of `mpslab.core.parameters.Wavemaker`; depth [m] is the still water
depth at the paddle, gravity is in m/s2 and end [s] is the end of the run. The motion does not
depend on the end; what is told of it (its stroke, its facts) may. Where its theory does not hold, a
module raises a ValueError that names the key. Every motion starts from rest at X = 0 without a jump
in velocity.

A paddle whose motion depends on what happens in the run has its own methods `advance`, `state` and
`restore` (`mpslab.solids.paddle.Paddle`).
"""
