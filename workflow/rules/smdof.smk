# Floor motions of the substitute chain.


rule floor_motions:
    input:
        record="results/{run}/records/{record}.csv",
        modules=code("floor_motions"),
    output:
        "results/{run}/smdof/{record}_{n}dof.csv",
    log:
        "results/{run}/logs/floor_motions_{record}_{n}.log",
    params:
        smdof=STUDY.params_of("smdof"),
    script:
        "../scripts/floor_motions.py"
