"""The pressure equation: its system, and what solves it."""
