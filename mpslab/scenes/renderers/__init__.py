"""What makes pixels of a scene; the file name is the backend of `mpslab.scenes.scene.draw`.

Each module has one function::

    render(scene) -> (h, w, 3) uint8

which draws a `mpslab.scenes.scene.Scene` on white: quads and surface in their colours as they are,
spheres in the light of `mpslab.scenes.light`, what is nearer over what is farther.
"""
