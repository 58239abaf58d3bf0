# Incremental dynamic analyses: one job a model, record and direction.


rule ida:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        plan=STUDY.plan,
        yade="results/{run}/yade.txt",
        modules=study_code("ida"),
    output:
        "results/{run}/ida/{model}/{record}_{direction}.csv",
    log:
        "results/{run}/logs/ida_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/ida_{model}_{record}_{direction}.tsv"
    params:
        yade=YADE,
        plan=plan_option,
        journal="results/{run}/cache/ida/{model}_{record}_{direction}.jsonl",
    shell:
        "{params.yade} ida --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction} {params.plan}"
        " --journal {params.journal:q} --output {output:q} 2> {log:q}"


rule ida_collapse:
    input:
        ida=lambda w: STUDY.ida_tables(w.run),
        ensemble=lambda w: STUDY.ensemble_tables(w.run),
        scans=lambda w: STUDY.scans(w.run),
        modules=code("ida/table_ida_collapse"),
    output:
        collapse="results/{run}/tables/ida_collapse.csv",
        probability="results/{run}/tables/collapse_probability.csv",
    log:
        "results/{run}/logs/ida_collapse.log",
    params:
        curves=lambda w: STUDY.curves(w.run),
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/ida/table_ida_collapse.py"
