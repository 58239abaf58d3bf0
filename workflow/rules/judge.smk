# The independent planar solver scans curves by itself; what of its answer the reported ones hold.


rule judge:
    input:
        with_pages(STUDY.per_run(ACCURACY.judge_results)),


rule judge_scan:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        scan="results/{run}/screening/{model}/{record}_{direction}.csv",
        modules=code("judge/judge_scan"),
    output:
        "results/{run}/judge/{model}/{record}_{direction}.csv",
    log:
        "results/{run}/logs/judge_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/judge_{model}_{record}_{direction}.tsv"
    params:
        record=lambda w: w.record,
        accuracy=lambda w: {
            key: STUDY.cfg(w)["accuracy"][key]
            for key in ("reference_nodes", "reference_tolerance", "judge_step")
        },
    script:
        "../scripts/judge/judge_scan.py"


rule judge_bands:
    input:
        scans=ACCURACY.judged,
        collapse="results/{run}/tables/ida_collapse.csv",
        modules=code("judge/table_judge"),
    output:
        scan="results/{run}/tables/judge_scan.csv",
        bands=shown(
            "results/{run}/tables/judge_bands.csv",
            "judge",
            "Accuracy and stability",
            "reported bands and the judge's (CSV)",
        ),
    log:
        "results/{run}/logs/judge_bands.log",
    params:
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/judge/table_judge.py"


rule figure_judge:
    input:
        scan="results/{run}/tables/judge_scan.csv",
        bands="results/{run}/tables/judge_bands.csv",
        probability="results/{run}/tables/collapse_probability.csv",
        facts=STUDY.record_facts,
        modules=code("judge/figure_judge"),
    output:
        **figure(
            "judge",
            "Accuracy and stability",
            "collapse probability by both planar solvers",
        ),
    log:
        "results/{run}/logs/figure_judge.log",
    params:
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/judge/figure_judge.py"
