# Pictures of the models, and what the study says about boundary conditions.
BRICKS_PUSHED = of_run(rules.pushover_curve.output[0], pushed="W3")


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


figure_by(
    "boundary/fig07_models",
    "fig07_models",
    "Boundary conditions",
    "7: the five models",
    frames=of_run(rules.frames.output[0], model=WITH_WALLS),
    facts=of_run(rules.own_record.output.facts, record=picture_record),
    params=dict(config=RUNS.params_of("facade", "return_wall", "w3", "pictures")),
)


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
        "../scripts/history/animation_collapse.py"


rule table_claims:
    input:
        collapse=rules.ida_collapse.output.collapse,
        facts=of_run(rules.record.output.facts),
        pushover=where(lambda run: "W3" in RUNS.settings[run]["models"], BRICKS_PUSHED),
    output:
        shown_table("claims", "Boundary conditions", "claims of the study"),
    params:
        w3=RUNS.params_of("w3"),
    script:
        "../scripts/boundary/table_claims.py"


rule boundary:
    """
    With the file that `study` takes: cohesion, interlocking, pushover, Figures 7, 8, 9,
    `tables/claims.csv`.
    Costs: 25 min; W3 most.
    """
    input:
        every_run(
            rules.table_pushover.output,
            rules.table_claims.output,
            rules.fig07_models.output.png,
            rules.fig08_w3.output.png,
            rules.fig09_ida.output.png,
            rules.figure_w3_sensitivity.output.png,
            of_run(rules.animation_collapse.output, model=["W2", "W3"]),
        ),
