# From an accelerogram to the dynamic capacity of a rocking façade: the workflow is in workflow/,
# where Snakemake's catalogue and `module:` look for it. README.md says how to run it.
include: "workflow/Snakefile"


rule main:
    default_target: True
    input:
        rules.all.input,
