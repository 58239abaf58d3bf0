# Pictures of a model in motion: frames of a run of YADE, and the animation of its collapse.


def picture_record(run):
    """Record that the pictures of a run show."""
    names = RUNS.records[run]
    return RUNS.settings[run]["pictures"]["record"] or names[min(1, len(names) - 1)]


rule frames:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0], record=picture_record),
        yade=rules.yade_check.output[0],
        modules=command_code("frames"),
    output:
        results("frames/{model}.json"),
    log:
        logs("frames_{model}"),
    params:
        yade=YADE,
        record=lambda w: picture_record(w.run),
        direction=value_of("pictures.direction"),
        pga=value_of("pictures.pga_g"),
    shell:
        "{params.yade} frames --scene {input.case:q} --motion {input.motion:q}"
        " --record {params.record:q} --direction {params.direction:q} --pga {params.pga:q}"
        " --fall 2 --output {output:q} 2> {log:q}"


rule collapse_frames:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0], record=picture_record),
        ida=of_run(
            rules.ida.output[0],
            record=picture_record,
            direction=RUNS.key("pictures.direction"),
        ),
        modules=command_code("frames"),
    output:
        results("frames/{model}_collapse.json"),
    log:
        logs("collapse_frames_{model}"),
    params:
        yade=YADE,
        record=lambda w: picture_record(w.run),
        direction=value_of("pictures.direction"),
        interval=value_of("pictures.frame_interval_s"),
    shell:
        "{params.yade} frames --scene {input.case:q} --motion {input.motion:q}"
        " --record {params.record:q} --direction {params.direction:q} --collapse {input.ida:q}"
        " --interval {params.interval:q} --fall 6 --output {output:q} 2> {log:q}"


rule animation_collapse:
    input:
        frames=rules.collapse_frames.output[0],
        facts=of_run(rules.own_record.output.facts, record=picture_record),
    output:
        shown(
            results("figures/collapse_{model}.gif"),
            "animation",
            "Boundary conditions",
            "collapse of {model}",
        ),
    log:
        logs("animation_{model}"),
    params:
        config=RUNS.params_of("facade", "return_wall", "w3", "pictures"),
    script:
        str(STUDIES / "shared" / "scripts" / "animation_collapse.py")
