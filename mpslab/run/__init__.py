"""The run: what a time step does, how a run begins, and when it must stop."""
