# Floor motions of the substitute chain.


rule floor_motions:
    input:
        record=rules.record.output.record,
        floors=of_alike(RUNS.floor_files),
    output:
        shared("{chain}/smdof/{record}_{n}dof.csv"),
    log:
        shared("{chain}/logs/floor_motions_{record}_{n}.log"),
    params:
        smdof=of_alike(RUNS.params_of("smdof")),
        floors=of_alike(RUNS.floors),
    script:
        "../scripts/smdof/floor_motions.py"


rule figure_floor_motions:
    input:
        motion=of_alike(of_run(rules.floor_motions.output[0])),
        facts=rules.record.output.facts,
    output:
        png=report(
            shared("{chain}/figures/floor_motions_{record}.png"),
            caption=caption("floor_motions"),
            category="Floor motions",
            labels=lambda w: {
                "run": SHARED.label(w),
                "record": w.record,
                "result": "floor motions and spectra",
            },
        ),
        pdf=shared("{chain}/figures/floor_motions_{record}.pdf"),
    log:
        shared("{chain}/logs/figure_floor_motions_{record}.log"),
    params:
        smdof=of_alike(RUNS.params_of("smdof")),
    script:
        "../scripts/smdof/figure_floor_motions.py"
