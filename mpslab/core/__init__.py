"""What all the rest stands on: cells, pairs and their geometry, and how libraries are loaded."""
