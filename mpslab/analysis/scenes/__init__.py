"""Frames in 3-D: the surface of the water, the view, the light, and the renderers."""
