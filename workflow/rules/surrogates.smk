# How far surrogates stand for recorded motions: collapse of both by the same scans; and how far
# draws of one surrogate differ. Ask for `surrogates`.


rule surrogates:
    input:
        with_pages(STUDY.per_run(SURROGATES.results)),


rule surrogate_collapse:
    input:
        record="results/{run}/records/{record}.csv",
        parameters=STUDY.surrogate_parameters,
        scenes=SURROGATES.scenes,
        modules=code("surrogates/surrogate_collapse"),
    output:
        "results/{run}/surrogates/{record}.csv",
    log:
        "results/{run}/logs/surrogates_{record}.log",
    benchmark:
        "results/{run}/benchmarks/surrogates_{record}.tsv"
    params:
        surrogates=lambda w: STUDY.cfg(w)["surrogates"],
        table=lambda w: STUDY.table_path(w.run),
        smdof=lambda w: STUDY.cfg(w)["smdof"],
        seed=lambda w: STUDY.cfg(w)["seed"],
        directions=lambda w: STUDY.cfg(w)["directions"],
        station=SURROGATES.station,
    script:
        "../scripts/surrogates/surrogate_collapse.py"


rule surrogate_trust:
    input:
        tables=SURROGATES.collapses,
        modules=code("surrogates/surrogate_trust"),
    output:
        table="results/{run}/tables/surrogates.csv",
        scatter="results/{run}/tables/surrogate_scatter.csv",
        summary="results/{run}/tables/surrogate_trust.csv",
    log:
        "results/{run}/logs/surrogate_trust.log",
    script:
        "../scripts/surrogates/surrogate_trust.py"


rule figure_surrogate_trust:
    input:
        table="results/{run}/tables/surrogates.csv",
        summary="results/{run}/tables/surrogate_trust.csv",
        facts=STUDY.record_facts,
        modules=code("surrogates/figure_surrogate_trust"),
    output:
        **figure("surrogate_trust", "Records", "surrogates beside their records"),
    log:
        "results/{run}/logs/figure_surrogate_trust.log",
    script:
        "../scripts/surrogates/figure_surrogate_trust.py"


rule figure_surrogate_scatter:
    input:
        table="results/{run}/tables/surrogates.csv",
        facts=STUDY.record_facts,
        modules=code("surrogates/figure_surrogate_scatter"),
    output:
        **figure("surrogate_scatter", "Records", "draws of surrogates"),
    log:
        "results/{run}/logs/figure_surrogate_scatter.log",
    script:
        "../scripts/surrogates/figure_surrogate_scatter.py"
