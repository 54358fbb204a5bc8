"""The validation suite is not part of the package: it lies beside it in the checkout."""

import sys
from pathlib import Path

# At the end, so that the mpslab under test stays the one that is installed.
sys.path.append(str(Path(__file__).parents[1]))
