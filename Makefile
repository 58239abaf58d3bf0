# make setup   what is missing: YADE from Debian's packages, a virtual environment with pinned packages
# make run     the main job (sets up what runs need first)
# make test    the tests and linters (sets up first)
# make quick   the tests that need neither YADE nor more than a second or two each
# make docs    the documentation site, build/site/index.html; a warning is an error. Names old pictures
# make gallery the pictures of docs/gallery.md again, by its commands
# make study   docs/study.md again: the study row by row beside a run of all its stages. CONFIG: settings, as records_table=FILE
# make predictions  predictions of tests again, into build/predictions, beside those committed; MOTIONS: folder of table motions
# make mutations  one sign, factor or unit changed at a time: do the tests notice?
# make freeze  the tables of a small run of every target, against those of REVISION (main)
# make faults  80 runs killed, starved or doubled at random moments; writes tables/faults.csv
# make slurm   two records through a real SLURM of one node (root; installs slurm-wlm and munge)
# make load    a study of 44 records in reduced form, with memory and progress over time
# make audit   known vulnerabilities of the locked packages (needs the internet)
CORES ?= $(shell nproc)
SNAKEMAKE = .venv/bin/snakemake --cores $(CORES)
RUN ?= main
.PHONY: setup run test quick lint docs gallery study predictions freeze mutations faults slurm load audit

setup:
	@bash tools/setup.sh

run:
	@bash tools/setup.sh run
	$(SNAKEMAKE) $(ARGS)

test: setup
	@$(MAKE) --no-print-directory -j2 --output-sync=target lint docs
	.venv/bin/python -m pytest $(ARGS)

quick: setup
	.venv/bin/python -m pytest -m "not yade and not slow" $(ARGS)

lint: setup
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/snakefmt --check workflow
	.venv/bin/mypy
	.venv/bin/python tools/lint_workflow.py

docs: setup
	.venv/bin/python -m sphinx -q -W --keep-going -c docs -d build/doctrees . build/site
	.venv/bin/python tools/gallery.py --old

gallery: setup
	.venv/bin/python tools/gallery.py $(ARGS)

study: setup
	$(SNAKEMAKE) --configfile config/scenarios/study.yaml $(if $(CONFIG),--config $(CONFIG)) -- study
	sed 's#](figures/#](pictures/study_#' results/study/study.md > docs/study.md
	.venv/bin/python tools/gallery.py --study results/study/figures

predictions: setup
	rm -rf build/predictions
	mkdir -p build
	cp -r config/predictions build
	@$(MAKE) --no-print-directory -j2 predicted-sin01 predicted-gables
	-diff -r --exclude=digest.txt config/predictions build/predictions

predicted-sin01: YADE = --yade $(if $(MOTIONS),--motions $(MOTIONS))
predicted-%:
	.venv/bin/python -m studies.validation.predictions run build/predictions/$* $(YADE)

REVISION ?= main
freeze: setup
	.venv/bin/python tests/trials/freeze.py run --revision $(REVISION) --output build/freeze/old
	.venv/bin/python tests/trials/freeze.py run --output build/freeze/new
	.venv/bin/python tests/trials/freeze.py compare build/freeze/old build/freeze/new

mutations: setup
	.venv/bin/python tests/trials/mutations/run.py $(ARGS)

faults: setup
	.venv/bin/python tests/trials/faults/trials.py --output results/$(RUN)/tables/faults.csv $(ARGS)

slurm: setup
	.venv/bin/python tests/trials/slurm/run_study.py

load: setup
	.venv/bin/python tests/trials/load/run_load.py --output results/$(RUN)/tables/load.csv $(ARGS)

audit: setup
	@bash tools/audit.sh
