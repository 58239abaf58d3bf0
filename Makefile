# make setup   what is missing: YADE from Debian's packages, a virtual environment with pinned packages
# make run     the main job (sets up first)
# make test    the tests and linters (sets up first)
CORES ?= $(shell nproc)
SNAKEMAKE = .venv/bin/snakemake --cores $(CORES)
.PHONY: setup run test lint

setup:
	@bash tools/setup.sh

run: setup
	$(SNAKEMAKE) $(ARGS)

test: setup lint
	.venv/bin/python -m pytest $(ARGS)

lint: setup
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/snakefmt --check Snakefile workflow
	.venv/bin/mypy
	.venv/bin/python tools/lint_workflow.py
