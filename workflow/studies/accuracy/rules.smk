# Accuracy and stability: `snakemake accuracy`.
ACCURACY_CURVES = {
    "model": RUNS.key("accuracy.models"),
    "record": RUNS.named("accuracy.records"),
    "direction": RUNS.key("accuracy.directions"),
}


def accuracy_cases(wildcards):
    """Scenes of its models, which the reference solver must know."""
    RUNS.needs_dry(wildcards.run)
    return of_run(rules.facade_case.output[0], model=RUNS.key("accuracy.models"))(wildcards)


rule stability:
    input:
        case=of_run(rules.facade_case.output[0], model="W2"),
        yade=rules.yade_check.output[0],
        modules=command_code("stability"),
    output:
        trials=results("tables/stability.csv"),
        limits=results("tables/stability_limits.csv"),
    log:
        logs("stability"),
    params:
        yade=YADE,
    shell:
        "{params.yade} stability --scene {input.case:q} --output {output.trials:q}"
        " --limits {output.limits:q} 2> {log:q}"


# The compiled planar solver finds intensities, tells what repeats, and gives the reference.
rule accuracy_plan:
    input:
        cases=accuracy_cases,
        motions=of_run(rules.floor_motions.output[0]),
    output:
        plan=results("accuracy/plan.json"),
        histories=results("accuracy/histories.csv"),
    benchmark:
        benchmarks("accuracy_plan")
    params:
        accuracy=value_of("accuracy"),
        max_pga_g=value_of("ida.max_pga_g"),
        records=lambda w: RUNS.records[w.run],
    script:
        "scripts/accuracy_plan.py"


rule accuracy_compiled:
    input:
        plan=rules.accuracy_plan.output.plan,
    output:
        results("accuracy/compiled.csv"),
    params:
        accuracy=value_of("accuracy"),
    script:
        "scripts/accuracy_compiled.py"


rule accuracy_runs:
    input:
        plan=rules.accuracy_plan.output.plan,
        yade=rules.yade_check.output[0],
        modules=command_code("accuracy"),
    output:
        results("accuracy/runs.csv"),
    log:
        logs("accuracy_runs"),
    benchmark:
        benchmarks("accuracy_runs")
    params:
        yade=YADE,
    shell:
        "{params.yade} accuracy --plan {input.plan:q} --output {output:q}" " 2> {log:q}"


rule accuracy_reference:
    input:
        plan=rules.accuracy_plan.output.plan,
    output:
        results("accuracy/reference.csv"),
    benchmark:
        benchmarks("accuracy_reference")
    threads: 2
    params:
        accuracy=value_of("accuracy"),
    script:
        "scripts/accuracy_reference.py"


rule speed_accuracy:
    input:
        runs=all_of(
            rules.accuracy_runs.output,
            rules.accuracy_compiled.output,
            lambda w: list(map(RUNS.find_file, RUNS.cfg(w)["accuracy"]["engines"])),
        ),
        reference=rules.accuracy_reference.output[0],
        plan=rules.accuracy_plan.output.plan,
        histories=rules.accuracy_plan.output.histories,
    output:
        table=shown_table("speed_accuracy", "Accuracy and stability", "speed against accuracy"),
        summary=shown_table(
            "accuracy_summary",
            "Accuracy and stability",
            "spread of errors by method",
            about="speed_accuracy",
        ),
        fidelity=results("accuracy/fidelity.yaml"),
    params:
        accuracy=value_of("accuracy"),
    script:
        "scripts/table_speed_accuracy.py"


figure_by(
    "studies/accuracy/scripts/figure_speed_accuracy",
    "speed_accuracy",
    "Accuracy and stability",
    "speed against accuracy",
    table=rules.speed_accuracy.output.table,
    facts=of_run(rules.record.output.facts),
)


figure_by(
    "studies/accuracy/scripts/figure_chaos",
    "chaos",
    "Accuracy and stability",
    "perturbed ensembles",
    ensembles=of_run(rules.ida.output.ensemble, **ACCURACY_CURVES),
    scans=of_run(rules.planar_ida.output.scan, **ACCURACY_CURVES),
    facts=of_run(rules.own_record.output.facts, record=RUNS.named("accuracy.records")),
    params=dict(
        percentiles=value_of("ensemble.percentiles"), spread=value_of("ensemble.amplitude_spread")
    ),
)


rule accuracy:
    """
    Critical step, convergence, chaos, speed against accuracy.
    Costs: 16 min.
    Page: docs/accuracy.md
    """
    input:
        every_run(
            rules.speed_accuracy.output.table,
            rules.speed_accuracy.output.summary,
            rules.stability.output.trials,
            rules.stability.output.limits,
            rules.figure_speed_accuracy.output.png,
            rules.figure_chaos.output.png,
        ),


include: "reference.smk"
