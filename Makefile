# Everything that a fresh machine needs beyond python3 and make is fetched into .venv.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Installed once, and again when what is to be installed changes.
STAMP := $(VENV)/.installed-for-development

.DEFAULT_GOAL := help
.PHONY: help run test coverage check golden check-ik bench bench-ik bench-code accuracy lint-c \
	repro mutants lock audit trust trust-cut vendor clean

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 16

run: $(STAMP) ## derive examples/planar_2r.yaml into out/ and name what it wrote
	$(BIN)/symdh derive examples/planar_2r.yaml -o out

test: $(STAMP) ## run the tests, on every core
	$(BIN)/python -m pytest -n auto --dist loadfile

# Left out: what counts calls to the disk, measures budgets of time and memory, or repeats runs.
# Coverage writes files of its own and slows what it watches; these find no line that others miss.
coverage: $(STAMP) ## run the tests under coverage; fails below 100 % of lines and branches
	$(BIN)/coverage erase
	$(BIN)/coverage run -m pytest -n auto --dist loadfile -m "not undisturbed" \
		--ignore tests/test_faults.py --ignore tests/test_hashseed.py
	$(BIN)/coverage combine --quiet
	$(BIN)/coverage report

check: $(STAMP) ## lint, formatting, types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

golden: $(STAMP) ## renew the golden files; look at the difference before committing
	SYMDH_UPDATE_GOLDEN=1 $(BIN)/python -m pytest tests/test_golden.py

check-ik: $(STAMP) ## inverse kinematics at length: every table, singular sets, counts beside EAIK
	$(BIN)/python tests/check_inverse.py
	$(BIN)/python tests/check_singular.py -j 2
	$(BIN)/python tests/check_eaik.py

bench: $(STAMP) ## measure against sympy's own simplify and bare imports
	$(BIN)/python tests/bench.py

bench-ik: $(STAMP) ## time inverse kinematics in C beside EAIK and IKFast
	$(BIN)/python tests/bench_ik.py

bench-code: $(STAMP) ## time generated code beside CasADi, SymForce, sympy and Pinocchio
	$(BIN)/python tests/bench_code.py

accuracy: $(STAMP) ## 1e5 poses of every table from C and Python, judged by mpmath at 50 digits
	$(BIN)/python tests/accuracy.py

lint-c: $(STAMP) ## every compiler and linter at its strictest over generated C of every table
	$(BIN)/python tests/lint_c.py

repro: $(STAMP) ## the same bytes over hash seeds, locales, versions of sympy and numpy
	$(BIN)/python tests/repro.py

mutants: $(STAMP) ## change the package at 200 random places; do the tests notice? (an hour)
	$(BIN)/python tests/mutation.py

lock: ## renew requirements-ci.txt, which CI installs from, within the ranges of pyproject.toml
	python3 tools/lock.py

audit: $(STAMP) ## dependencies: locked, within range, declared, free to use; known vulnerabilities
	$(BIN)/python tools/audit.py

trust: $(STAMP) ## fuzzing, faults, mutants and the like, each figure beside its goal (30 min)
	$(BIN)/python tests/trust.py

trust-cut: $(STAMP) ## the ten minutes of it that CI runs
	$(BIN)/python tests/trust.py --cut

vendor: ## renew the vendored KaTeX from npm (KATEX=0.19.1 for one version)
	python3 tools/vendor_katex.py $(KATEX)

clean: ## remove everything that make made
	rm -rf $(VENV) .mutation .coverage* out build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(STAMP): pyproject.toml requirements-ci.txt tools/make_venv.py
	@echo "setting up $(VENV), once"
	@$(PYTHON) tools/make_venv.py $(VENV)
	@touch $@
