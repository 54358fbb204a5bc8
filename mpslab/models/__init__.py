"""Models of a step that a case does not choose from a family by name."""
