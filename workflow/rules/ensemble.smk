# Perturbed ensembles: how far each curve repeats, and bands where it does not.


rule ida_ensemble:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        plan=STUDY.plan,
        curve="results/{run}/ida/{model}/{record}_{direction}.csv",
        modules=study_code("ensemble"),
    output:
        ensemble="results/{run}/ida/{model}/{record}_{direction}_ensemble.csv",
        sensitivity="results/{run}/ida/{model}/{record}_{direction}_sensitivity.csv",
    log:
        "results/{run}/logs/ensemble_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/ensemble_{model}_{record}_{direction}.tsv"
    params:
        yade=YADE,
        plan=plan_option,
        journal="results/{run}/cache/ensemble/{model}_{record}_{direction}.jsonl",
    shell:
        "{params.yade} ensemble --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction} {params.plan}"
        " --curve {input.curve:q} --journal {params.journal:q}"
        " --output {output.ensemble:q} --sensitivity {output.sensitivity:q}"
        " 2> {log:q}"
