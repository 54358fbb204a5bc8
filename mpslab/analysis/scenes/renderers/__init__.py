"""Renderers, which make the pixels of a scene.

The file name is the `backend` of `mpslab.analysis.scenes.scene.draw`.  Each module has one
function::

    render(scene) -> (h, w, 3) uint8

which draws a `mpslab.analysis.scenes.scene.Scene` on white: quads and surface in the colours they
have, spheres lit by `mpslab.analysis.scenes.light`, near things over far ones.
"""
