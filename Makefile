# Everything that a fresh machine needs beyond python3 and make is fetched into .venv.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Installed once, and again when what is to be installed changes.
STAMP := $(VENV)/.installed-for-development

.DEFAULT_GOAL := help
.PHONY: help run test check golden bench vendor clean

help: ## list the targets
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 16

run: $(STAMP) ## derive examples/planar_2r.yaml into out/ and name what it wrote
	$(BIN)/symdh derive examples/planar_2r.yaml -o out

test: $(STAMP) ## run the tests
	$(BIN)/python -m pytest

check: $(STAMP) ## lint, formatting, types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

golden: $(STAMP) ## renew the golden files; look at the difference before committing
	SYMDH_UPDATE_GOLDEN=1 $(BIN)/python -m pytest tests/test_golden.py

bench: $(STAMP) ## measure against sympy's own simplify and bare imports
	$(BIN)/python tests/bench.py

vendor: ## renew the vendored KaTeX from npm (KATEX=0.19.1 for one version)
	python3 tools/vendor_katex.py $(KATEX)

clean: ## remove everything that make made
	rm -rf $(VENV) out build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(STAMP): pyproject.toml tools/make_venv.py
	@echo "setting up $(VENV), once"
	@$(PYTHON) tools/make_venv.py $(VENV)
	@touch $@
