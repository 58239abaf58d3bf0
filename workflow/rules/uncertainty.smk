# Uncertainty of material and model beside that of the motion: ask for `uncertainty`.
wildcard_constraints:
    cell=r"cell\d+",


rule uncertainty:
    input:
        lambda w: with_pages(STUDY.per_run(UNCERTAINTY.results)),


rule uncertainty_collapse:
    input:
        record="results/{run}/records/{record}.csv",
        scenes=UNCERTAINTY.scenes,
        modules=code("uncertainty/uncertainty_collapse"),
    output:
        "results/{run}/uncertainty/{record}.csv",
    log:
        "results/{run}/logs/uncertainty_{record}.log",
    benchmark:
        "results/{run}/benchmarks/uncertainty_{record}.tsv"
    params:
        settings=UNCERTAINTY.params(),
        direction=UNCERTAINTY.direction,
    script:
        "../scripts/uncertainty/uncertainty_collapse.py"


rule uncertainty_cells:
    input:
        tables=UNCERTAINTY.collapses,
        records=UNCERTAINTY.records,
        scenes=UNCERTAINTY.scenes,
        modules=code("uncertainty/uncertainty_cells"),
    output:
        "results/{run}/uncertainty/cells.json",
    log:
        "results/{run}/logs/uncertainty_cells.log",
    params:
        settings=UNCERTAINTY.params("confirm"),
    script:
        "../scripts/uncertainty/uncertainty_cells.py"


rule uncertainty_yade:
    input:
        cells="results/{run}/uncertainty/cells.json",
        yade="results/{run}/yade.txt",
        modules=study_code("cells"),
    output:
        "results/{run}/uncertainty/yade/{cell}.csv",
    log:
        "results/{run}/logs/uncertainty_yade_{cell}.log",
    params:
        yade=YADE,
    shell:
        "{params.yade} cells --cells {input.cells:q} --cell {wildcards.cell:q}"
        " --output {output:q} 2> {log:q}"


rule uncertainty_confirm:
    input:
        cells="results/{run}/uncertainty/cells.json",
        yade=UNCERTAINTY.confirmed,
        modules=code("uncertainty/uncertainty_confirm"),
    output:
        "results/{run}/tables/uncertainty_confirm.csv",
    log:
        "results/{run}/logs/uncertainty_confirm.log",
    script:
        "../scripts/uncertainty/uncertainty_confirm.py"


rule uncertainty_tables:
    input:
        tables=UNCERTAINTY.collapses,
        modules=code("uncertainty/uncertainty_tables"),
    output:
        samples="results/{run}/uncertainty/samples.csv",
        parts="results/{run}/tables/uncertainty_parts.csv",
        sensitivity="results/{run}/tables/uncertainty_sensitivity.csv",
        fragility="results/{run}/tables/uncertainty_fragility.csv",
    log:
        "results/{run}/logs/uncertainty_tables.log",
    params:
        settings=UNCERTAINTY.params("confidence"),
    script:
        "../scripts/uncertainty/uncertainty_tables.py"


rule figure_uncertainty:
    input:
        parts="results/{run}/tables/uncertainty_parts.csv",
        sensitivity="results/{run}/tables/uncertainty_sensitivity.csv",
        fragility="results/{run}/tables/uncertainty_fragility.csv",
        facts=UNCERTAINTY.facts,
        modules=code("uncertainty/figure_uncertainty"),
    output:
        **figure("uncertainty", "Fragility", "motion, material and model form"),
    log:
        "results/{run}/logs/figure_uncertainty.log",
    script:
        "../scripts/uncertainty/figure_uncertainty.py"
