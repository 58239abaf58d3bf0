# Dense scans by the compiled planar solver: every island of collapse, and what YADE is to run.


rule screen:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        modules=code("ida/screen"),
    output:
        scan="results/{run}/screening/{model}/{record}_{direction}.csv",
        plan="results/{run}/screening/{model}/{record}_{direction}.json",
    log:
        "results/{run}/logs/screen_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/screen_{model}_{record}_{direction}.tsv"
    params:
        record=lambda w: w.record,
    script:
        "../scripts/ida/screen.py"
