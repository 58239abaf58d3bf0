# Energy balance of single runs; part of the accuracy study.


rule energy_balance:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        curve="results/{run}/ida/{model}/{record}_{direction}.csv",
        yade="results/{run}/yade.txt",
        modules=study_code("energy"),
    output:
        "results/{run}/energy/{model}/{record}_{direction}_{share}.csv",
    log:
        "results/{run}/logs/energy_{model}_{record}_{direction}_{share}.log",
    wildcard_constraints:
        share=r"\d+(\.\d+)?",
    params:
        yade=YADE,
    shell:
        "{params.yade} energy --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --curve {input.curve:q} --share {wildcards.share:q} --output {output:q}"
        " 2> {log:q}"


rule table_energy_balance:
    input:
        histories=ACCURACY.energy_histories,
        modules=code("energy/table_energy_balance"),
    output:
        shown(
            "results/{run}/tables/energy_balance.csv",
            "energy_balance",
            "Accuracy and stability",
            "energy balance (CSV)",
        ),
    log:
        "results/{run}/logs/table_energy_balance.log",
    params:
        share=lambda w: STUDY.cfg(w)["accuracy"]["energy_share"],
    script:
        "../scripts/energy/table_energy_balance.py"


rule figure_energy_balance:
    input:
        histories=ACCURACY.energy_histories,
        facts=ACCURACY.facts,
        modules=code("energy/figure_energy_balance"),
    output:
        **figure("energy_balance", "Accuracy and stability", "energy balance"),
    log:
        "results/{run}/logs/figure_energy_balance.log",
    params:
        share=lambda w: STUDY.cfg(w)["accuracy"]["energy_share"],
    script:
        "../scripts/energy/figure_energy_balance.py"
