"""The validation suite: cases held against theory and experiment, and a report of them."""
