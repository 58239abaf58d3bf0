# From an accelerogram to the dynamic capacity of a rocking façade.
# `snakemake -n` lists the jobs; README.md says how to run, override and extend.
from snakemake.utils import min_version

min_version("9.0")


configfile: "config/config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/targets.smk"
include: "workflow/rules/records.smk"
include: "workflow/rules/smdof.smk"
include: "workflow/rules/facade.smk"
include: "workflow/rules/ida.smk"
include: "workflow/rules/ensemble.smk"
include: "workflow/rules/figures.smk"


rule all:
    default_target: True
    input:
        per_run(main_results),
