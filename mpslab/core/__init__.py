"""What all the rest stands on: the grid of cells, and how libraries are loaded."""
