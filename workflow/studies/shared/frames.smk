# Frames of a run of YADE, for pictures of a model in motion.


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
