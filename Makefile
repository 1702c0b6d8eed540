# Two commands set up everything: `make demo` and `make test`.
# They need Python 3.11 or 3.12 and make; the environment goes to .venv.

PYTHON ?= $(shell command -v python3.11 || command -v python3.12 || command -v python3)
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

# Small matrices in Drake callbacks are several times slower with threaded BLAS;
# PARDISO asks for its threads itself.
export OPENBLAS_NUM_THREADS := 1
export MPLBACKEND := Agg

.PHONY: demo test check format slow verify bench clean

demo: $(READY)
	$(BIN)/drake-landing demo

test: check
	$(BIN)/python -m pytest

check: $(READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/lint-imports
	$(BIN)/pyright

format: $(READY)
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

slow: $(READY)
	$(BIN)/python -m pytest -m slow

verify: $(READY)
	$(BIN)/python -m benchmarks.verification

bench: $(READY)
	$(BIN)/python -m benchmarks

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[test]'
	touch $@

clean:
	rm -rf $(VENV) out build *.egg-info
