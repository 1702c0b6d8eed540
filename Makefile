# Two commands set up everything: `make demo` and `make test`.
# They need Python 3.12 or 3.11 and make; the environment goes to .venv. Another Python
# than the first that is found: make PYTHON=/path/to/python

VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

# Small matrices in Drake callbacks are several times slower with threaded BLAS;
# PARDISO asks for its threads itself.
export OPENBLAS_NUM_THREADS := 1
export MPLBACKEND := Agg

.PHONY: audit demo fuzz test check format slow verify docs bench python clean

demo: $(READY)
	$(BIN)/drake-landing demo

# Files of tests side by side; each process takes up to 1.5 GB.
test: check
	$(BIN)/python -m pytest -n auto --maxprocesses 4 --dist loadfile

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

fuzz: $(READY)
	$(BIN)/python -m benchmarks.fuzz 1500

# Known vulnerabilities of the pinned packages; asks the advisories of PyPI.
audit: $(READY)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt pip-audit
	$(BIN)/pip-audit -r constraints.txt --no-deps --disable-pip

verify: $(READY)
	$(BIN)/python -m benchmarks.verification

docs: $(READY)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[docs]'
	$(BIN)/python -m mkdocs build --strict --quiet

bench: $(READY)
	$(BIN)/python -m benchmarks

$(READY): pyproject.toml constraints.txt | python
	"$$(./find_python.sh $(VENV) $(PYTHON))" -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[test]'
	touch $@

# Says which Python it is before anything takes time, or what is in the way.
python:
	@found=$$(./find_python.sh $(VENV) $(PYTHON)) || exit 1; \
	test -e $(READY) || echo "$(VENV) is made with $$found"

clean:
	rm -rf $(VENV) out build *.egg-info
