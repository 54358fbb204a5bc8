"""Build of the compiled kernels.

Two switches, read from the environment:

MPSLAB_PORTABLE=1
    Leave out ``-march=native``, so that the build runs on any machine of this architecture.
MPSLAB_CHECKED=1
    Check every array index in the kernels (slow; for the tests).
"""

import os
from pathlib import Path

from Cython.Build import cythonize
from setuptools import Extension, setup

CHECKED = os.environ.get("MPSLAB_CHECKED") == "1"
PORTABLE = os.environ.get("MPSLAB_PORTABLE") == "1"
# Each kind of build in its own place: none takes over what another has compiled.
KIND = "kernels-checked" if CHECKED else "kernels-portable" if PORTABLE else "kernels"

# Fast mathematics lets the compiler sum a row in vector lanes.  Not-a-number stays a number that
# can be tested for, and nothing goes into the link arguments: there, the option would switch
# denormal numbers off in the whole process.
FLAGS = ["-O1"] if CHECKED else ["-O3", "-ffast-math", "-fno-finite-math-only"]
FLAGS += ["-Wno-psabi"]  # no word on how vectors are handed over: they are not, but inlined
FLAGS += ["-g0"]  # no tables for a debugger: they take a third of the time to compile
if not (CHECKED or PORTABLE):
    FLAGS += ["-march=native", "-mtune=generic"]

CORES = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1

# The code behind array arguments, once for all kernels: in each, it takes most of the time to
# compile.
SHARED = "mpslab._memoryviews"

DIRECTIVES = {
    "language_level": 3,
    "boundscheck": CHECKED,
    "wraparound": False,
    "initializedcheck": False,
    "cdivision": True,
}


def extensions():
    """One extension for each .pyx below the package, and one for what they share."""
    for source in sorted(Path("mpslab").rglob("*.pyx")):
        name = ".".join(source.with_suffix("").parts)
        yield Extension(
            name, [str(source)], extra_compile_args=FLAGS, include_dirs=["mpslab/kernels"],
            depends=["mpslab/kernels/lanes.h"],
        )  # fmt: skip
    yield Extension(SHARED, ["mpslab/_memoryviews.c"], extra_compile_args=FLAGS)


setup(
    ext_modules=cythonize(
        list(extensions()),
        compiler_directives=DIRECTIVES,
        build_dir=f"build/{KIND}/cython",
        nthreads=CORES,
        shared_utility_qualified_name=SHARED,
    ),
    options={
        "build_ext": {"parallel": CORES, "force": CHECKED or PORTABLE},
        "build": {"build_base": f"build/{KIND}"},
    },
)
