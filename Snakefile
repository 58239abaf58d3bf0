# From an accelerogram to the dynamic capacity of a rocking façade.
# `snakemake -n` lists the jobs; README.md says how to run, override and extend.
from pathlib import Path

from snakemake.utils import min_version

min_version("9.0")

# the working folder's own configuration, or the project's
OWN = Path("config/config.yaml")


configfile: str(OWN if OWN.exists() else Path(workflow.basedir) / OWN)


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/report_tables.smk"
include: "workflow/rules/records.smk"
include: "workflow/rules/smdof.smk"
include: "workflow/rules/facade.smk"
include: "workflow/rules/ida.smk"
include: "workflow/rules/ensemble.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/calibration.smk"
include: "workflow/rules/building.smk"
include: "workflow/rules/pushover.smk"
include: "workflow/rules/boundary.smk"
include: "workflow/rules/fragility.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        with_pages(STUDY.per_run(STUDY.main_results)),
