"""Compiled loops over particles and neighbours: functions on bare arrays, nothing else."""
