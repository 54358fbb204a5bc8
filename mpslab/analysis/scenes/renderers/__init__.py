"""What makes pixels of a scene; the file name is the backend of
`mpslab.analysis.scenes.scene.draw`.

Each module has one function::

    render(scene) -> (h, w, 3) uint8

which draws a `mpslab.analysis.scenes.scene.Scene` on white: quads and surface in their colours as
they are, spheres in the light of `mpslab.analysis.scenes.light`, what is nearer over what is
farther.
"""
