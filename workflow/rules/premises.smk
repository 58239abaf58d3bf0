# What the driven return walls are worth, beside every other premise: models side by side, a map over
# buildings, a tornado chart. Ask for `premises`; config/scenarios/premises.yaml has the runs.
PREMISES = RUNS.key("premises")


def tornado_records(run):
    """Records of the tornado chart; all where none are named."""
    named = PREMISES(run)["tornado_records"]
    return (
        RUNS.records[run]
        if named is None
        else RUNS.named("premises.tornado_records")(run)
    )


def without_scan(run):
    """Curves that no dense scan stands for."""
    return [c for c in RUNS.by_yade(run) if not RUNS.scanned(run, c.model)]


def tornado_models(run):
    """Models with a tornado chart."""
    return PREMISES(run)["tornado_models"] if tornado_records(run) else []


rule table_premises:
    input:
        scans=of_run(rules.screen.output.scan, cases=RUNS.scans),
        bricks=of_run(rules.ida.output[0], cases=without_scan),
        others=lambda w: list(map(RUNS.beside, PREMISES(w.run)["other_curves"])),
        facts=of_run(rules.record.output.facts),
        modules=code("premises/table_premises"),
    output:
        table=results("tables/premises.csv"),
        ratios=results("tables/premises_ratios.csv"),
        losses=results("tables/premises_losses.csv"),
        probability=results("premises/probability.csv"),
    log:
        logs("table_premises"),
    params:
        spread=lambda w: RUNS.cfg(w)["ensemble"]["amplitude_spread"],
        reference=lambda w: PREMISES(w.run)["reference"],
        benchmarks=results("benchmarks"),
    script:
        "../scripts/premises/table_premises.py"


rule figure_premises:
    input:
        probability=rules.table_premises.output.probability,
        facts=of_run(rules.record.output.facts),
        modules=code("premises/figure_premises"),
    output:
        **figure("premises", "Premises", "collapse probability, models side by side"),
    log:
        logs("figure_premises"),
    params:
        facade=RUNS.params_of("facade"),
    script:
        "../scripts/premises/figure_premises.py"


rule figure_premises_ratios:
    input:
        table=rules.table_premises.output.table,
        facts=of_run(rules.record.output.facts),
        modules=code("premises/figure_premises_ratios"),
    output:
        **figure("premises_ratios", "Premises", "each model over the reference"),
    log:
        logs("figure_premises_ratios"),
    params:
        reference=lambda w: PREMISES(w.run)["reference"],
    script:
        "../scripts/premises/figure_premises_ratios.py"


rule premises_map:
    input:
        scene=of_run(rules.scene.output[0], model="W2"),
        record=rules.own_record.output.record,
        modules=code("premises/premises_map"),
    output:
        results("premises/map/{record}.csv"),
    log:
        logs("premises_map_{record}"),
    benchmark:
        benchmarks("premises_map_{record}")
    params:
        premises=lambda w: {
            key: PREMISES(w.run)[key]
            for key in ("mass_ratios", "periods_s", "damping_ratios", "level_ratio")
        },
        directions=lambda w: RUNS.cfg(w)["directions"],
    script:
        "../scripts/premises/premises_map.py"


rule table_premises_map:
    input:
        curves=of_run(rules.premises_map.output[0]),
        modules=code("premises/table_premises_map"),
    output:
        results("tables/premises_map.csv"),
    log:
        logs("table_premises_map"),
    script:
        "../scripts/premises/table_premises_map.py"


rule figure_premises_map:
    input:
        table=rules.table_premises_map.output[0],
        facts=of_run(rules.record.output.facts),
        modules=code("premises/figure_premises_map"),
    output:
        **figure("premises_map", "Premises", "error of driven walls, by building"),
    log:
        logs("figure_premises_map"),
    params:
        smdof=lambda w: RUNS.cfg(w)["smdof"],
        records=lambda w: len(RUNS.records[w.run]),
        directions=lambda w: len(RUNS.cfg(w)["directions"]),
    script:
        "../scripts/premises/figure_premises_map.py"


rule premises_stage:
    input:
        fit=rules.building_fit.output[0],
        cbdem=of_run(rules.building_modal.output[0], building="CBDEM"),
        sbdem=of_run(rules.building_modal.output[0], building="SBDEM"),
        modules=code("premises/premises_stage"),
    output:
        results("premises/stage.json"),
    log:
        logs("premises_stage"),
    script:
        "../scripts/premises/premises_stage.py"


rule premises_varied:
    input:
        scene=rules.scene.output[0],
        stage=rules.premises_stage.output[0],
        record=rules.own_record.output.record,
        law=LAW_FILE,
        modules=code("premises/premises_varied"),
    output:
        results("premises/{model}/{record}.csv"),
    log:
        logs("premises_varied_{model}_{record}"),
    benchmark:
        benchmarks("premises_varied_{model}_{record}")
    params:
        directions=lambda w: RUNS.cfg(w)["directions"],
        surrogates_table=lambda w: RUNS.beside(PREMISES(w.run)["surrogates_table"]),
        seed=lambda w: RUNS.cfg(w)["seed"],
    script:
        "../scripts/premises/premises_varied.py"


rule table_premises_tornado:
    input:
        curves=of_run(rules.premises_varied.output[0], record=tornado_records),
        modules=code("premises/table_premises_tornado"),
    output:
        results("tables/premises_tornado_{model}.csv"),
    log:
        logs("table_premises_tornado_{model}"),
    script:
        "../scripts/premises/table_premises_tornado.py"


rule figure_premises_tornado:
    input:
        table=rules.table_premises_tornado.output[0],
        facts=of_run(rules.record.output.facts),
        modules=code("premises/figure_premises_tornado"),
    output:
        **figure(
            "premises_tornado_{model}",
            "Premises",
            "what each premise of {model} is worth",
            about="premises_tornado",
        ),
    log:
        logs("figure_premises_tornado_{model}"),
    params:
        facade=RUNS.params_of("facade"),
    script:
        "../scripts/premises/figure_premises_tornado.py"


rule premises:
    input:
        every_run(
            rules.table_premises.output.table,
            rules.table_premises.output.ratios,
            rules.table_premises.output.losses,
            rules.figure_premises.output.png,
            rules.figure_premises_ratios.output.png,
            where(
                RUNS.key("premises.mass_ratios"),
                rules.table_premises_map.output,
                rules.figure_premises_map.output.png,
            ),
            of_run(
                rules.table_premises_tornado.output,
                rules.figure_premises_tornado.output.png,
                model=tornado_models,
            ),
        ),
