# How far surrogates stand for recorded motions: collapse of both by the same scans. Ask for
# `surrogates`, with a table of recorded motions.


rule surrogates:
    input:
        with_pages(STUDY.per_run(SURROGATES.results)),


rule surrogate_collapse:
    input:
        record=SURROGATES.recorded,
        scenes=SURROGATES.scenes,
        modules=code("surrogate_collapse"),
    output:
        "results/{run}/surrogates/{record}.csv",
    log:
        "results/{run}/logs/surrogates_{record}.log",
    benchmark:
        "results/{run}/benchmarks/surrogates_{record}.tsv"
    params:
        surrogates=lambda w: STUDY.cfg(w)["surrogates"],
        smdof=lambda w: STUDY.cfg(w)["smdof"],
        seed=lambda w: STUDY.cfg(w)["seed"],
        directions=lambda w: STUDY.cfg(w)["directions"],
        station=SURROGATES.station,
    script:
        "../scripts/surrogate_collapse.py"


rule surrogate_trust:
    input:
        tables=SURROGATES.collapses,
        modules=code("surrogate_trust"),
    output:
        table="results/{run}/tables/surrogates.csv",
        summary="results/{run}/tables/surrogate_trust.csv",
    log:
        "results/{run}/logs/surrogate_trust.log",
    script:
        "../scripts/surrogate_trust.py"


rule figure_surrogate_trust:
    input:
        table="results/{run}/tables/surrogates.csv",
        summary="results/{run}/tables/surrogate_trust.csv",
        facts=STUDY.record_facts,
        modules=code("figure_surrogate_trust"),
    output:
        png=report(
            "results/{run}/figures/surrogate_trust.png",
            caption=caption("surrogate_trust"),
            category="Records",
            labels={"run": "{run}", "result": "surrogates beside their records"},
        ),
        pdf="results/{run}/figures/surrogate_trust.pdf",
    log:
        "results/{run}/logs/figure_surrogate_trust.log",
    script:
        "../scripts/figure_surrogate_trust.py"
