# One history of one model at one intensity: `results/<run>/histories/W2/RRS228_neg_0.2g.png`.
wildcard_constraints:
    pga=r"\d+(\.\d+)?",


rule history:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        yade="results/{run}/yade.txt",
        modules=study_code("history"),
    output:
        "results/{run}/histories/{model}/{record}_{direction}_{pga}g.csv",
    log:
        "results/{run}/logs/history_{model}_{record}_{direction}_{pga}g.log",
    params:
        yade=YADE,
    shell:
        "{params.yade} history --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --pga {wildcards.pga:q} --output {output:q} 2> {log:q}"


rule figure_history:
    input:
        history="results/{run}/histories/{model}/{record}_{direction}_{pga}g.csv",
        facts="results/{run}/records/{record}.json",
        modules=code("history/figure_history"),
    output:
        shown(
            "results/{run}/histories/{model}/{record}_{direction}_{pga}g.png",
            "history",
            "Histories",
            "{model}, {record} {direction}, {pga} g",
        ),
    log:
        "results/{run}/logs/figure_history_{model}_{record}_{direction}_{pga}g.log",
    script:
        "../scripts/history/figure_history.py"


use rule frames as history_frames with:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        yade="results/{run}/yade.txt",
        modules=study_code("frames"),
    output:
        "results/{run}/histories/{model}/{record}_{direction}_{pga}g.json",
    log:
        "results/{run}/logs/history_frames_{model}_{record}_{direction}_{pga}g.log",
    params:
        yade=YADE,
        record=lambda w: w.record,
        direction=lambda w: w.direction,
        pga=lambda w: w.pga,


use rule animation_collapse as animation_history with:
    input:
        frames="results/{run}/histories/{model}/{record}_{direction}_{pga}g.json",
        facts="results/{run}/records/{record}.json",
        modules=code("history/animation_collapse"),
    output:
        "results/{run}/histories/{model}/{record}_{direction}_{pga}g.gif",
    log:
        "results/{run}/logs/animation_{model}_{record}_{direction}_{pga}g.log",
