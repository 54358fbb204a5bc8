# mpslab: the commands, on a fresh machine with Python 3.11 or later and gcc.

PYTHON ?= python3
BIN := .venv/bin
SOURCES := $(shell find mpslab -name '*.pyx' -o -name '*.pxd' -o -name '*.h') setup.py pyproject.toml

.PHONY: help tank test build-checked test-checked validation figures bench pictures lint clean

help:
	@echo "make tank   build mpslab and run the plunging breaker; pictures land in runs/"
	@echo "make test   build mpslab and run its tests"
	@echo "make test-checked   the tests of the kernels again, every array index in them checked"
	@echo "make validation     the quick validation suite; its report lands in runs/validation/quick"
	@echo "make figures  the paper's figures at 4 mm; they land in runs/paper_figures/quick"
	@echo "make bench  time steps on 1, 2 and 4 ranks, SPACING=0.002 for the paper's resolution;"
	@echo "            the loops of a step beside their rooflines land in benchmarks/results/"
	@echo "make pictures   run the tank of docs and draw its pictures anew"
	@echo "make lint   check the style of the code"
	@echo "make clean  remove what was built (results in runs/ stay)"

tank: .venv/built
	$(BIN)/python -m mpslab.tank

# On all cores; the tests of one file stay together, as many share a run.
PYTEST := $(BIN)/pytest -n auto --dist loadfile
test: .venv/tested lint
	$(PYTEST)

# These lead into every function of the kernels, most on some hundred particles.  What starts
# processes of its own, as runs from the command line do, has the usual kernels there.
CHECKED := $(patsubst %,tests/test_%.py,cells copied deflation determinism forces friction gauges \
  gradients laplacians neighbors neighbourhood pressure rows solvers sources stabilisers step \
  surface viscosity walls)
build-checked: build/checked/built
build/checked/built: .venv/tested $(SOURCES) $(shell find mpslab -name '*.py')
	MPSLAB_CHECKED=1 $(BIN)/python -m pip install -q --no-deps --upgrade --target build/checked .
	touch $@

test-checked: build-checked
	PYTHONPATH=build/checked $(PYTEST) $(CHECKED)

validation: .venv/tested
	$(BIN)/python -m validation

figures: .venv/tested
	$(BIN)/python -m paper_figures --quick --run

SPACING ?= 0.004
bench: .venv/benched
	$(BIN)/python -m pytest benchmarks --spacing=$(SPACING) --benchmark-autosave
	$(BIN)/python -m benchmarks.report

pictures: .venv/built
	$(BIN)/python docs/pictures.py

lint: .venv/tested
	$(BIN)/ruff check .

clean:
	rm -rf .venv build *.egg-info .pytest_cache .ruff_cache .hypothesis .benchmarks
	find mpslab -name '*.so' -delete

.venv/bin/python:
	$(PYTHON) -c "import sys; sys.exit(sys.version_info < (3, 11) and 'mpslab needs Python 3.11 or later')"
	$(PYTHON) -m venv .venv

.venv/built: .venv/bin/python $(SOURCES)
	$(BIN)/python -m pip install -q -e .
	touch $@

# Not after .venv/built: each install compiles all kernels.
.venv/tested: .venv/bin/python $(SOURCES)
	$(BIN)/python -m pip install -q -e '.[test]'
	touch .venv/built $@

.venv/benched: .venv/built
	$(BIN)/python -m pip install -q -e '.[test,bench]'
	touch $@
