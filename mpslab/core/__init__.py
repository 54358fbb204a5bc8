"""What all parts of the package stand on."""
