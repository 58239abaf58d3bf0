# Floor motions of the substitute chain.


rule floor_motions:
    input:
        record="results/.shared/{motions}/records/{record}.csv",
        modules=code("smdof/floor_motions"),
    output:
        "results/.shared/{motions}/{chain}/smdof/{record}_{n}dof.csv",
    log:
        "results/.shared/{motions}/{chain}/logs/floor_motions_{record}_{n}.log",
    params:
        smdof=SHARED.of(STUDY.params_of("smdof")),
    script:
        "../scripts/smdof/floor_motions.py"
