"""What all the rest stands on: the lattice, the grid of cells, and how libraries are loaded."""
