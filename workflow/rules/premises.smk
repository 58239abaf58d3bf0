# What the driven return walls are worth, beside every other premise: models side by side, a map over
# buildings, a tornado chart. Ask for `premises`; config/scenarios/premises.yaml has the runs.
PREMISES = study.Premises(STUDY)


rule premises:
    input:
        with_pages(STUDY.per_run(PREMISES.results)),


rule table_premises:
    input:
        scans=lambda w: STUDY.scans(w.run),
        bricks=PREMISES.bricks,
        others=PREMISES.others,
        facts=STUDY.record_facts,
        modules=code("premises/table_premises"),
    output:
        table="results/{run}/tables/premises.csv",
        ratios="results/{run}/tables/premises_ratios.csv",
        losses="results/{run}/tables/premises_losses.csv",
        probability="results/{run}/premises/probability.csv",
    log:
        "results/{run}/logs/table_premises.log",
    params:
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
        reference=lambda w: PREMISES.settings(w.run)["reference"],
        benchmarks=lambda w: f"results/{w.run}/benchmarks",
    script:
        "../scripts/premises/table_premises.py"


rule figure_premises:
    input:
        probability="results/{run}/premises/probability.csv",
        facts=STUDY.record_facts,
        modules=code("premises/figure_premises"),
    output:
        **figure("premises", "Premises", "collapse probability, models side by side"),
    log:
        "results/{run}/logs/figure_premises.log",
    params:
        facade=STUDY.params_of("facade"),
    script:
        "../scripts/premises/figure_premises.py"


rule figure_premises_ratios:
    input:
        table="results/{run}/tables/premises.csv",
        facts=STUDY.record_facts,
        modules=code("premises/figure_premises_ratios"),
    output:
        **figure("premises_ratios", "Premises", "each model over the reference"),
    log:
        "results/{run}/logs/figure_premises_ratios.log",
    params:
        reference=lambda w: PREMISES.settings(w.run)["reference"],
    script:
        "../scripts/premises/figure_premises_ratios.py"


rule premises_map:
    input:
        scene="results/{run}/scenes/W2.json",
        record="results/{run}/records/{record}.csv",
        modules=code("premises/premises_map"),
    output:
        "results/{run}/premises/map/{record}.csv",
    log:
        "results/{run}/logs/premises_map_{record}.log",
    benchmark:
        "results/{run}/benchmarks/premises_map_{record}.tsv"
    params:
        premises=lambda w: {
            key: PREMISES.settings(w.run)[key]
            for key in ("mass_ratios", "periods_s", "damping_ratios", "level_ratio")
        },
        directions=lambda w: STUDY.cfg(w)["directions"],
    script:
        "../scripts/premises/premises_map.py"


rule table_premises_map:
    input:
        curves=PREMISES.sweep,
        modules=code("premises/table_premises_map"),
    output:
        "results/{run}/tables/premises_map.csv",
    log:
        "results/{run}/logs/table_premises_map.log",
    script:
        "../scripts/premises/table_premises_map.py"


rule figure_premises_map:
    input:
        table="results/{run}/tables/premises_map.csv",
        facts=STUDY.record_facts,
        modules=code("premises/figure_premises_map"),
    output:
        **figure("premises_map", "Premises", "error of driven walls, by building"),
    log:
        "results/{run}/logs/figure_premises_map.log",
    params:
        smdof=lambda w: STUDY.cfg(w)["smdof"],
        records=lambda w: len(STUDY.records[w.run]),
        directions=lambda w: len(STUDY.cfg(w)["directions"]),
    script:
        "../scripts/premises/figure_premises_map.py"


rule premises_stage:
    input:
        fit="results/{run}/building/fit.json",
        cbdem="results/{run}/building/CBDEM_modes.npz",
        sbdem="results/{run}/building/SBDEM_modes.npz",
        modules=code("premises/premises_stage"),
    output:
        "results/{run}/premises/stage.json",
    log:
        "results/{run}/logs/premises_stage.log",
    script:
        "../scripts/premises/premises_stage.py"


rule premises_varied:
    input:
        scene="results/{run}/scenes/{model}.json",
        stage="results/{run}/premises/stage.json",
        record="results/{run}/records/{record}.csv",
        law=LAW_FILE,
        modules=code("premises/premises_varied"),
    output:
        "results/{run}/premises/{model}/{record}.csv",
    log:
        "results/{run}/logs/premises_varied_{model}_{record}.log",
    benchmark:
        "results/{run}/benchmarks/premises_varied_{model}_{record}.tsv"
    params:
        directions=lambda w: STUDY.cfg(w)["directions"],
        surrogates_table=lambda w: STUDY.beside(
            PREMISES.settings(w.run)["surrogates_table"]
        ),
        seed=lambda w: STUDY.cfg(w)["seed"],
    script:
        "../scripts/premises/premises_varied.py"


rule table_premises_tornado:
    input:
        curves=lambda w: PREMISES.tornado(w),
        modules=code("premises/table_premises_tornado"),
    output:
        "results/{run}/tables/premises_tornado_{model}.csv",
    log:
        "results/{run}/logs/table_premises_tornado_{model}.log",
    script:
        "../scripts/premises/table_premises_tornado.py"


rule figure_premises_tornado:
    input:
        table="results/{run}/tables/premises_tornado_{model}.csv",
        facts=STUDY.record_facts,
        modules=code("premises/figure_premises_tornado"),
    output:
        **figure(
            "premises_tornado_{model}",
            "Premises",
            "what each premise of {model} is worth",
            about="premises_tornado",
        ),
    log:
        "results/{run}/logs/figure_premises_tornado_{model}.log",
    params:
        facade=STUDY.params_of("facade"),
    script:
        "../scripts/premises/figure_premises_tornado.py"
