"""What all of the package works on."""
