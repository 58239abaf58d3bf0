# Incremental dynamic analyses: one job a model, record and direction.


def ida_motion(wildcards):
    n = cfg(wildcards)["smdof"]["n_dof"]
    return f"results/{wildcards.run}/smdof/{wildcards.record}_{n}dof.csv"


rule ida:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=ida_motion,
        yade="results/{run}/yade.txt",
        modules=yade_modules(),
    output:
        "results/{run}/ida/{model}/{record}_{direction}.csv",
    params:
        python=YADE_PYTHON,
        entry=str(BASE / "yade_scripts" / "run_ida.py"),
        journal="results/{run}/cache/ida/{model}_{record}_{direction}.jsonl",
    log:
        "results/{run}/logs/ida_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/ida_{model}_{record}_{direction}.tsv"
    shell:
        "{params.python:q} {params.entry:q} --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --journal {params.journal:q} --output {output:q} 2> >(tee {log:q} >&2)"


def ida_tables(run):
    resolved = RUNS[run]
    return [
        f"results/{run}/ida/{model}/{record}_{direction}.csv"
        for model in resolved["models"]
        for record in record_names(run)
        for direction in resolved["directions"]
    ]


rule ida_collapse:
    input:
        ida=lambda w: ida_tables(w.run),
    output:
        report(
            "results/{run}/tables/ida_collapse.csv",
            caption=caption("table_ida_collapse"),
            category="Incremental dynamic analyses",
            labels={"table": "collapse intensities"},
        ),
    log:
        "results/{run}/logs/ida_collapse.log",
    script:
        "../scripts/table_ida_collapse.py"
