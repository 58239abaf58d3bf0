# One history of one model at one intensity: `results/<run>/histories/W2/GMN_NS_neg_0.2g.png`.
wildcard_constraints:
    pga=r"\d+(\.\d+)?",


rule history:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        yade=rules.yade_check.output[0],
        modules=command_code("history"),
    output:
        results("histories/{model}/{record}_{direction}_{pga}g.csv"),
    log:
        logs("history_{model}_{record}_{direction}_{pga}g"),
    params:
        yade=YADE,
    shell:
        "{params.yade} history --scene {input.case:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --pga {wildcards.pga:q} --output {output:q} 2> {log:q}"


rule figure_history:
    input:
        history=rules.history.output[0],
        facts=rules.own_record.output.facts,
    output:
        shown(
            results("histories/{model}/{record}_{direction}_{pga}g.png"),
            "history",
            "Histories",
            "{model}, {record} {direction}, {pga} g",
        ),
    log:
        logs("figure_history_{model}_{record}_{direction}_{pga}g"),
    script:
        "scripts/figure_history.py"


use rule frames as history_frames with:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        yade=rules.yade_check.output[0],
        modules=command_code("frames"),
    output:
        results("histories/{model}/{record}_{direction}_{pga}g.json"),
    log:
        logs("history_frames_{model}_{record}_{direction}_{pga}g"),
    params:
        record=lambda w: w.record,
        direction=lambda w: w.direction,
        pga=lambda w: w.pga,


rule animation_history:
    input:
        frames=rules.history_frames.output[0],
        facts=rules.own_record.output.facts,
    output:
        results("histories/{model}/{record}_{direction}_{pga}g.gif"),
    log:
        logs("animation_{model}_{record}_{direction}_{pga}g"),
    params:
        config=RUNS.params_of("facade", "return_wall", "w3"),
    script:
        "scripts/animation_history.py"


# For ParaView: blocks as bodies, contacts with their forces, at every 0.02 s.
rule history_acting:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        yade=rules.yade_check.output[0],
        modules=command_code("frames"),
    output:
        temp(results("histories/{model}/{record}_{direction}_{pga}g_acting.json")),
    log:
        logs("history_acting_{model}_{record}_{direction}_{pga}g"),
    params:
        yade=YADE,
    shell:
        "{params.yade} frames --scene {input.case:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --pga {wildcards.pga:q} --contacts --output {output:q} 2> {log:q}"


rule history_vtk:
    input:
        frames=rules.history_acting.output[0],
    output:
        collection=results("histories/{model}/{record}_{direction}_{pga}g.pvd"),
        instants=directory(results("histories/{model}/{record}_{direction}_{pga}g")),
    log:
        logs("history_vtk_{model}_{record}_{direction}_{pga}g"),
    params:
        config=RUNS.params_of("facade", "return_wall", "w3"),
    script:
        "scripts/history_vtk.py"
