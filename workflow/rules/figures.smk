# Figures of the main job.


rule figure_record:
    input:
        record="results/.shared/{motions}/records/{record}.csv",
        facts="results/.shared/{motions}/records/{record}.json",
        modules=code("records/figure_record"),
    output:
        png=report(
            "results/.shared/{motions}/figures/record_{record}.png",
            caption=caption("record"),
            category="Records",
            labels=lambda w: {
                "run": SHARED.label(w),
                "record": w.record,
                "result": "accelerogram",
            },
        ),
        pdf="results/.shared/{motions}/figures/record_{record}.pdf",
    log:
        "results/.shared/{motions}/logs/figure_record_{record}.log",
    script:
        "../scripts/records/figure_record.py"


rule figure_floor_motions:
    input:
        motion=SHARED.of(STUDY.ida_motion),
        facts="results/.shared/{motions}/records/{record}.json",
        modules=code("smdof/figure_floor_motions"),
    output:
        png=report(
            "results/.shared/{motions}/{chain}/figures/floor_motions_{record}.png",
            caption=caption("floor_motions"),
            category="Floor motions",
            labels=lambda w: {
                "run": SHARED.label(w),
                "record": w.record,
                "result": "floor motions and spectra",
            },
        ),
        pdf="results/.shared/{motions}/{chain}/figures/floor_motions_{record}.pdf",
    log:
        "results/.shared/{motions}/{chain}/logs/figure_floor_motions_{record}.log",
    params:
        smdof=SHARED.of(STUDY.params_of("smdof")),
    script:
        "../scripts/smdof/figure_floor_motions.py"


rule fig09_ida:
    input:
        ida=lambda w: STUDY.ida_tables(w.run),
        scans=lambda w: STUDY.scans(w.run),
        collapse="results/{run}/tables/ida_collapse.csv",
        probability="results/{run}/tables/collapse_probability.csv",
        pushover=lambda w: STUDY.static_curves(w.run),
        facts=STUDY.record_facts,
        modules=code("ida/fig09_ida"),
    output:
        **figure(
            "fig09_ida", "Incremental dynamic analyses", "9: IDA curves", about="fig09"
        ),
    log:
        "results/{run}/logs/fig09_ida.log",
    params:
        records=lambda w: STUDY.records[w.run],
        models=lambda w: STUDY.cfg(w)["models"],
        directions=lambda w: STUDY.cfg(w)["directions"],
        facade=STUDY.params_of("facade"),
    script:
        "../scripts/ida/fig09_ida.py"
