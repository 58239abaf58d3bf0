# What vertical motion changes in collapse: ask for `vertical`, with records that have one.


rule vertical:
    input:
        with_pages(STUDY.per_run(VERTICAL.results)),


rule vertical_collapse:
    input:
        files=VERTICAL.files,
        scenes=VERTICAL.scenes,
        modules=code("vertical/vertical_collapse"),
    output:
        "results/{run}/vertical/{record}.csv",
    log:
        "results/{run}/logs/vertical_{record}.log",
    benchmark:
        "results/{run}/benchmarks/vertical_{record}.tsv"
    params:
        table=lambda w: STUDY.table_path(w.run),
        station=SURROGATES.station,
        settings=STUDY.params_of("directions", "baseline", "seed", "ida.max_pga_g"),
    script:
        "../scripts/vertical/vertical_collapse.py"


rule vertical_ratios:
    input:
        tables=VERTICAL.collapses,
        modules=code("vertical/vertical_ratios"),
    output:
        table="results/{run}/tables/vertical.csv",
        summary="results/{run}/tables/vertical_ratios.csv",
    log:
        "results/{run}/logs/vertical_ratios.log",
    script:
        "../scripts/vertical/vertical_ratios.py"


rule figure_vertical:
    input:
        table="results/{run}/tables/vertical.csv",
        facts=STUDY.record_facts,
        modules=code("vertical/figure_vertical"),
    output:
        **figure("vertical", "Records", "what vertical motion changes"),
    log:
        "results/{run}/logs/figure_vertical.log",
    script:
        "../scripts/vertical/figure_vertical.py"
