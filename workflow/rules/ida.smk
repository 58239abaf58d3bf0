# Incremental dynamic analyses: one job a model, record and direction.


rule ida:
    input:
        entry=module("yade_scripts/studies/ida.py"),
        scene="results/{run}/scenes/{model}.json",
        motion=ida_motion,
        yade="results/{run}/yade.txt",
        modules=yade_modules(),
    output:
        "results/{run}/ida/{model}/{record}_{direction}.csv",
    log:
        "results/{run}/logs/ida_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/ida_{model}_{record}_{direction}.tsv"
    params:
        python=YADE_PYTHON,
        journal="results/{run}/cache/ida/{model}_{record}_{direction}.jsonl",
    shell:
        "{params.python:q} {input.entry:q} --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --journal {params.journal:q} --output {output:q} 2> >(tee {log:q} >&2)"


rule ida_collapse:
    input:
        ida=lambda w: ida_tables(w.run),
        ensemble=lambda w: ensemble_tables(w.run),
    output:
        "results/{run}/tables/ida_collapse.csv",
    log:
        "results/{run}/logs/ida_collapse.log",
    params:
        percentiles=lambda w: cfg(w)["ensemble"]["percentiles"],
    script:
        "../scripts/table_ida_collapse.py"
