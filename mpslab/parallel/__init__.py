"""Which rank owns what, and how the ranks speak with each other."""
