"""What all the rest stands on: the grid of cells."""
