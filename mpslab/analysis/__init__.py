"""What engineers read off a run: sea states, waves one by one, reflection, run-up, overtopping.

The functions take arrays in SI units; `mpslab.sea` reads a run and puts them together.
"""
