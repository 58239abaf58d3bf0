# Incremental dynamic analyses of each model, record and direction: a dense scan by the compiled planar solver, then
# YADE, in one process, at the intensities that it names and in perturbed ensembles that tell how far both repeat.


def plan(wildcards):
    """What YADE is to run, from the dense scan; nothing where there is none."""
    scanned = RUNS.scanned(wildcards.run, wildcards.model)
    return of_run(rules.planar_ida.output.plan)(wildcards) if scanned else []


rule planar_ida:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
    output:
        scan=results("planar/{model}/{record}_{direction}.csv"),
        plan=results("planar/{model}/{record}_{direction}.json"),
    benchmark:
        benchmarks("planar_ida_{model}_{record}_{direction}")
    params:
        record=lambda w: w.record,
    script:
        str(BASE / "workflow/scripts/ida/planar_ida.py")


rule ida:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        plan=plan,
        yade=rules.yade_check.output[0],
        modules=command_code("ida"),
    output:
        curve=results("ida/{model}/{record}_{direction}.csv"),
        ensemble=results("ida/{model}/{record}_{direction}_ensemble.csv"),
    log:
        logs("ida_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("ida_{model}_{record}_{direction}")
    params:
        yade=YADE,
        plan=plan_option,
        record=lambda w: w.record,
        ensemble="--ensemble",
        journal=results("cache/ida/{model}_{record}_{direction}.jsonl"),
    shell:
        "{params.yade} ida --scene {input.case:q} --motion {input.motion:q}"
        " --record {params.record:q} --direction {wildcards.direction} {params.plan}"
        " --journal {params.journal:q} --output {output.curve:q} {params.ensemble} 2> {log:q}"


rule ida_collapse:
    input:
        ida=of_run(rules.ida.output[0], cases=RUNS.by_yade),
        ensemble=of_run(rules.ida.output.ensemble, cases=RUNS.ensembles),
        scans=of_run(rules.planar_ida.output.scan, cases=RUNS.scans),
    output:
        collapse=results("tables/ida_collapse.csv"),
        probability=results("tables/collapse_probability.csv"),
    params:
        curves=lambda w: list(map(tuple, RUNS.curves(w.run))),
        spread=value_of("ensemble.amplitude_spread"),
        slope=value_of("risk.hazard_slope"),
    script:
        "../scripts/ida/table_ida_collapse.py"


figure_by(
    "ida/fig09_ida",
    "fig09_ida",
    "Incremental dynamic analyses",
    "9: IDA curves",
    ida=of_run(rules.ida.output[0], cases=RUNS.by_yade),
    scans=of_run(rules.planar_ida.output.scan, cases=RUNS.scans),
    collapse=rules.ida_collapse.output.collapse,
    probability=rules.ida_collapse.output.probability,
    pushover=of_run(rules.pushover_curve.output[0], pushed=RUNS.pushed),
    facts=of_run(rules.record.output.facts),
    params=dict(
        records=lambda w: RUNS.records[w.run],
        models=value_of("models"),
        directions=value_of("directions"),
        facade=RUNS.params_of("facade"),
    ),
)


# What a run ends with: one table and one figure over all its motions.
rule table_answer:
    input:
        ida=of_run(rules.ida.output[0], cases=RUNS.by_yade),
        scans=of_run(rules.planar_ida.output.scan, cases=RUNS.scans),
        collapse=rules.ida_collapse.output.collapse,
        probability=rules.ida_collapse.output.probability,
    output:
        answer=results("tables/answer.csv"),
        curves=results("tables/answer_curves.csv"),
        checked=results("tables/answer_yade.csv"),
    params:
        models=value_of("models"),
        stations=RUNS.stations,
    script:
        "../scripts/ida/table_answer.py"


figure_by(
    "ida/answer",
    "answer",
    "Answer",
    "at what shaking it falls, with what probability",
    answer=rules.table_answer.output.answer,
    curves=rules.table_answer.output.curves,
    checked=rules.table_answer.output.checked,
    facts=of_run(rules.record.output.facts),
    params=dict(
        about=lambda w: in_a_line(RUNS.cfg(w)),
        drift=value_of("smdof.fallen_drift_ratio"),
        facade=RUNS.params_of("facade"),
    ),
)
