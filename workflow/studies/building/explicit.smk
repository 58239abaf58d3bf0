# The building by explicit integration in YADE, as a check of its modes and of what gravity does at once.
from yade_scripts.model.gravity import GRAVITY_M_S2


def explicit_size(run):
    """Brick size of the explicit run."""
    return f"{RUNS.settings[run]['building']['explicit_coarsening']:g}"


rule building_explicit_scene:
    input:
        plan=plan_file,
        fit=rules.building_fit.output[0],
    output:
        results("building/explicit_scene_{coarsening}.json"),
    params:
        building=values_of(
            "building",
            *BRICK_MODEL,
            "damping_ratio",
            "explicit_step_fraction",
            "explicit_duration_s",
        ),
    script:
        "scripts/building_explicit_scene.py"


# The drawing's building under the record, with its dead load applied at once or left out.
rule building_explicit:
    input:
        scene=of_run(rules.building_explicit_scene.output[0], coarsening=explicit_size),
        record=rules.own_record.output.record,
        yade=rules.yade_check.output[0],
        modules=command_code("explicit_building"),
    output:
        history=results("building/explicit_{load}_{record}.csv"),
    log:
        logs("building_explicit_{load}_{record}"),
    benchmark:
        benchmarks("building_explicit_{load}_{record}")
    wildcard_constraints:
        load="plain|loaded",
    params:
        yade=YADE,
        gravity=lambda w: {"plain": 0.0, "loaded": GRAVITY_M_S2}[w.load],
    shell:
        "{params.yade} explicit_building --scene {input.scene:q} --motion {input.record:q}"
        " --gravity {params.gravity} --output {output.history:q} 2> {log:q}"


rule table_building_explicit:
    input:
        plan=plan_file,
        fit=rules.building_fit.output[0],
        scene=of_run(rules.building_explicit_scene.output[0], coarsening=explicit_size),
        plain=of_run(rules.building_explicit.output.history, load="plain"),
        loaded=of_run(rules.building_explicit.output.history, load="loaded"),
        record=rules.own_record.output.record,
        facts=rules.own_record.output.facts,
    output:
        **figure(
            "fig03_rattling_{record}",
            "Building",
            "explicit and modal, rattling",
            about="fig03_rattling",
            record="{record}",
        ),
        table=results("tables/building_explicit_{record}.csv"),
    params:
        building=values_of("building", *BRICK_MODEL),
    script:
        "scripts/table_building_explicit.py"
