# What a roof's load and friction are worth: collapse PGA by planar scans, YADE's members on them.


rule restrain:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        modules=code("restraint/restraint"),
    output:
        table="results/{run}/restraint/{model}/{record}_{direction}.csv",
        plan="results/{run}/restraint/{model}/{record}_{direction}.json",
    log:
        "results/{run}/logs/restraint_{model}_{record}_{direction}.log",
    params:
        settings=STUDY.params_of("restraint"),
    script:
        "../scripts/restraint/restraint.py"


use rule strengthen_yade as restrain_yade with:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        plan="results/{run}/restraint/{model}/{record}_{direction}.json",
        yade="results/{run}/yade.txt",
        modules=study_code("strengthening"),
    output:
        "results/{run}/restraint/{model}/{record}_{direction}_yade.csv",
    log:
        "results/{run}/logs/restraint_yade_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/restraint_yade_{model}_{record}_{direction}.tsv"
    params:
        yade=YADE,
        journal="results/{run}/cache/restraint/{model}_{record}_{direction}.jsonl",


rule figure_restraint:
    input:
        tables=lambda w: STRENGTHENING.curves(
            w.run, "restraint", ".csv", w.record, w.direction
        ),
        yade=lambda w: STRENGTHENING.curves(
            w.run, "restraint", "_yade.csv", w.record, w.direction
        ),
        facts="results/{run}/records/{record}.json",
        modules=code("restraint/figure_restraint"),
    output:
        png=report(
            "results/{run}/restraint/{record}_{direction}.png",
            caption=caption("restraint"),
            category="Strengthening",
            labels={"run": "{run}", "result": "roof, {record} {direction}"},
        ),
        pdf="results/{run}/restraint/{record}_{direction}.pdf",
    log:
        "results/{run}/logs/figure_restraint_{record}_{direction}.log",
    script:
        "../scripts/restraint/figure_restraint.py"


rule restraint:
    input:
        with_pages(STUDY.per_run(STRENGTHENING.restraint_results)),
