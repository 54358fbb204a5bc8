"""Frames in 3-D: the surface of the water, the view, the light, and what makes pixels of them."""
