# Perturbed ensembles: how far each curve repeats, and bands where it does not.


rule ida_ensemble:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=ida_motion,
        curve="results/{run}/ida/{model}/{record}_{direction}.csv",
        modules=yade_modules()
        + module("yade_scripts/perturb.py", "yade_scripts/run_ensemble.py"),
    output:
        ensemble="results/{run}/ida/{model}/{record}_{direction}_ensemble.csv",
        sensitivity="results/{run}/ida/{model}/{record}_{direction}_sensitivity.csv",
    log:
        "results/{run}/logs/ensemble_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/ensemble_{model}_{record}_{direction}.tsv"
    params:
        python=YADE_PYTHON,
        entry=str(BASE / "yade_scripts" / "run_ensemble.py"),
        journal="results/{run}/cache/ensemble/{model}_{record}_{direction}.jsonl",
    shell:
        "{params.python:q} {params.entry:q} --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --curve {input.curve:q} --journal {params.journal:q}"
        " --output {output.ensemble:q} --sensitivity {output.sensitivity:q}"
        " 2> >(tee {log:q} >&2)"


def ensemble_tables(run):
    """Ensemble tables of a run; none where config switches them off."""
    if RUNS[run]["ensemble"]["enabled"] == "off":
        return []
    return [path.replace(".csv", "_ensemble.csv") for path in ida_tables(run)]


def sensitivity_tables(run):
    """Sensitivity tables of a run, made by the same jobs."""
    return [
        path.replace("_ensemble.csv", "_sensitivity.csv")
        for path in ensemble_tables(run)
    ]
