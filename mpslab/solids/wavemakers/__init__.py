"""Wavemakers: each module holds one, `make(wavemaker, depth, gravity, end) -> Paddle`.

`wavemaker` has the attributes of `mpslab.core.parameters.Wavemaker`; depth [m] is the still water
depth at the paddle, gravity is in m/s2 and end [s] is the end of the run, on which the motion does
not depend. A module raises ValueError, naming the key, where its theory does not hold. Every motion
starts from rest at X = 0 without a jump in velocity.

A paddle whose motion follows from what happens in the run has methods of its own for `advance`,
`state` and `restore` (`mpslab.solids.paddle.Paddle`).
"""
