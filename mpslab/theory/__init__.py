"""Wave theory: pure functions of numbers in SI units, which know nothing of a case or a run."""
