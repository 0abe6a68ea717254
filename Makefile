# Two commands on a fresh machine: `make demo` and `make test`. Each sets up .venv once.
# PYTHON may name an interpreter; otherwise the first of these that is 3.11 or later and has venv and ensurepip.
CANDIDATES := $(PYTHON) python3.11 python3.12 python3.13 python3.14 python3 python
USABLE := import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))
BIN := .venv/bin

.PHONY: demo console test lint types floors unit soak pictures clean
.DEFAULT_GOAL := help

help:
	@echo "make demo       set up, then plan, fly and report nine vehicles (scenario radars)"
	@echo "make console    set up, then fly nine vehicles and show them in the browser (ARGS='vee --speed 5')"
	@echo "make test       set up, then ruff, mypy, import-linter and pytest"
	@echo "make soak       hostile traffic, lossy links, killed ends, failures in flight and gusts by the thousand; figures to runs/soak/soak.json"
	@echo "make pictures   fly the shipped scenarios and renew the README's pictures"
	@echo "make clean      remove .venv and caches"

demo: .venv/.installed
	$(BIN)/skein demo

console: .venv/.console
	@# 1 is a flight that fell short, as one does that is ended before all have arrived
	$(BIN)/skein console --open $(ARGS) || [ $$? -eq 1 ]

test: lint types floors unit

lint: .venv/.tested
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: .venv/.tested
	$(BIN)/mypy

floors: .venv/.tested
	$(BIN)/lint-imports

unit: .venv/.tested
	$(BIN)/pytest -n auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder

soak: .venv/.installed
	$(BIN)/python -m gcs.bench.soak

pictures: .venv/.tested
	$(BIN)/python -m gcs.pictures docs/pictures

clean:
	rm -rf .venv .mypy_cache .ruff_cache .pytest_cache .import_linter_cache .hypothesis

.venv/.created: Makefile
	@python=""; \
	for candidate in $(CANDIDATES); do \
	  if $$candidate -c "$(USABLE)" >/dev/null 2>&1; then python=$$candidate; break; fi; \
	done; \
	if [ -z "$$python" ]; then echo "skein needs Python 3.11 or later with venv and ensurepip; set PYTHON=/path/to/python3" >&2; exit 2; fi; \
	$$python -m venv .venv
	@touch $@

.venv/.installed: .venv/.created pyproject.toml constraints.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable .
	@touch $@

.venv/.console: .venv/.installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[console]'
	@touch $@

.venv/.tested: .venv/.installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[test]'
	@touch $@
