# Figures of the main job.


rule figure_record:
    input:
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
        style=STYLE,
    output:
        png=report(
            "results/{run}/figures/record_{record}.png",
            caption=caption("record"),
            category="Records",
            labels={
                "run": "{run}",
                "record": "{record}",
                "result": "accelerogram",
            },
        ),
        pdf="results/{run}/figures/record_{record}.pdf",
    log:
        "results/{run}/logs/figure_record_{record}.log",
    script:
        "../scripts/figure_record.py"


rule figure_floor_motions:
    input:
        motion=ida_motion,
        facts="results/{run}/records/{record}.json",
        style=STYLE,
    output:
        png=report(
            "results/{run}/figures/floor_motions_{record}.png",
            caption=caption("floor_motions"),
            category="Floor motions",
            labels={
                "run": "{run}",
                "record": "{record}",
                "result": "floor motions and spectra",
            },
        ),
        pdf="results/{run}/figures/floor_motions_{record}.pdf",
    log:
        "results/{run}/logs/figure_floor_motions_{record}.log",
    params:
        smdof=params_of("smdof"),
    script:
        "../scripts/figure_floor_motions.py"


rule fig09_ida:
    input:
        ida=lambda w: ida_tables(w.run),
        ensemble=lambda w: ensemble_tables(w.run),
        sensitivity=lambda w: sensitivity_tables(w.run),
        pushover=lambda w: static_curves(w.run),
        facts=record_facts,
        style=STYLE,
    output:
        png=report(
            "results/{run}/figures/fig09_ida.png",
            caption=caption("fig09"),
            category="Incremental dynamic analyses",
            labels={"run": "{run}", "result": "9: IDA curves"},
        ),
        pdf="results/{run}/figures/fig09_ida.pdf",
    log:
        "results/{run}/logs/fig09_ida.log",
    params:
        records=lambda w: RECORDS[w.run],
        models=lambda w: cfg(w)["models"],
        directions=lambda w: cfg(w)["directions"],
        facade=params_of("facade"),
        percentiles=lambda w: cfg(w)["ensemble"]["percentiles"],
    script:
        "../scripts/fig09_ida.py"
