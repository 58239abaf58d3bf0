# The independent planar solver scans curves by itself; what of its answer the reported ones hold.


def judged(wildcards):
    """Dense scans by the independent planar solver, of the models that it can describe."""
    run = wildcards.run
    RUNS.needs_plain(run, "the judge", held=True)
    models = [model for model in RUNS.settings[run]["models"] if model in PLANAR]
    return of_run(rules.judge_scan.output[0], model=models)(wildcards)


rule judge_scan:
    input:
        scene=rules.scene.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        scan=rules.screen.output.scan,
        modules=code("judge/judge_scan"),
    output:
        results("judge/{model}/{record}_{direction}.csv"),
    log:
        logs("judge_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("judge_{model}_{record}_{direction}")
    params:
        record=lambda w: w.record,
        accuracy=lambda w: {
            key: RUNS.cfg(w)["accuracy"][key]
            for key in ("reference_nodes", "reference_tolerance", "judge_step")
        },
    script:
        "../scripts/judge/judge_scan.py"


rule judge_bands:
    input:
        scans=judged,
        collapse=rules.ida_collapse.output.collapse,
        modules=code("judge/table_judge"),
    output:
        scan=results("tables/judge_scan.csv"),
        bands=shown(
            results("tables/judge_bands.csv"),
            "judge",
            "Accuracy and stability",
            "reported bands and the judge's (CSV)",
        ),
    log:
        logs("judge_bands"),
    params:
        spread=lambda w: RUNS.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/judge/table_judge.py"


rule figure_judge:
    input:
        scan=rules.judge_bands.output.scan,
        bands=rules.judge_bands.output.bands,
        probability=rules.ida_collapse.output.probability,
        facts=of_run(rules.record.output.facts),
        modules=code("judge/figure_judge"),
    output:
        **figure(
            "judge",
            "Accuracy and stability",
            "collapse probability by both planar solvers",
        ),
    log:
        logs("figure_judge"),
    params:
        spread=lambda w: RUNS.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/judge/figure_judge.py"


rule judge:
    input:
        every_run(rules.judge_bands.output, rules.figure_judge.output.png),
