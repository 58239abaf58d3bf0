# The complete building: brick model, façade cracked off (CB) or bonded (CBc). Not part of the main
# job; ask for `complete`.
COMPLETE_SECTIONS = RUNS.params_of(
    "facade",
    "return_wall",
    "damping",
    "numerics",
    "building",
    "complete",
    "ida.max_pga_g",
)


wildcard_constraints:
    complete="|".join(COMPLETE),


def complete_settings(run):
    """Section complete of a run."""
    return RUNS.settings[run]["complete"]


def bricks(run, coarsening=None):
    """Wildcards of a scene: the configured brick size, or another."""
    size = complete_settings(run)["coarsening"] if coarsening is None else coarsening
    return {"coarsening": f"{size:g}"}


def brick_sizes(run):
    """Wildcards of the scenes by brick size."""
    return [bricks(run, size) for size in complete_settings(run)["convergence"]]


def curve_scene(wildcards):
    """Scene of a curve."""
    if RUNS.cfg(wildcards)["vertical_motion"] == "on":
        raise SystemExit(
            "error: complete: expected vertical_motion = off: the complete building has been checked"
            " under horizontal motion alone"
        )
    run = wildcards.run
    RUNS.needs_plain(run, "the complete building", held=True)
    return of_run(rules.complete_scene.output[0], **bricks(run))(wildcards)


def history_motion(wildcards):
    """Motion of a history of the checks."""
    if wildcards.kind in ("linear", "level"):
        return CHECK_MOTION(wildcards)
    return of_run(rules.complete_pulse.output[0])(wildcards)


def history_options(wildcards):
    """Options of a history of the checks."""
    settings, kind = complete_settings(wildcards.run), wildcards.kind
    pga_g = settings["check_pga_g" if kind == "level" else "linear_pga_g"]
    options = [f"--direction {settings['check_direction']} --pga {pga_g:g}"]
    if kind in ("linear", "level"):
        until_s = settings[f"{'check' if kind == 'level' else kind}_duration_s"]
        options.append(f"--until {until_s:g}")
    return " ".join(options + ["--apart"] * (kind == "apart"))


def linear_history(kind):
    """Input function: a history of the bonded building, as a list."""
    return of_run(
        rules.complete_history.output.history,
        cases=lambda run: [{"complete": "CBc", "kind": kind, **bricks(run)}],
    )


def two_way(model):
    """Name of the reduced model with the same joint whose walls answer the façade."""
    how = ("floors", COMPLETE[model].bonded, True)
    return next(m.name for m in MODELS.values() if (m.walls, m.bonded, m.two_way) == how)


def two_way_curves(run):
    """Curves of the reduced models compared with those that YADE runs."""
    models = [two_way(model) for model in complete_settings(run)["models"]]
    records, directions = RUNS.confirmed(run), RUNS.settings[run]["directions"]
    return [CurveKey(*names) for names in product(models, records, directions)]


LEVELS = {"complete": "CB", "kind": "level", "cases": brick_sizes}
COMPLETE_MODELS = RUNS.key("complete.models")
CHECK_MOTION = of_run(
    rules.floor_motions.output[0],
    record=lambda run: RUNS.named("complete.check_record")(run)[0],
)


rule complete_scene:
    input:
        plan=plan_file,
        fit=rules.building_fit.output[0],
        fidelity=FIDELITY_FILE,
        law=LAW_FILE,
    output:
        results("complete/cases/{complete}_{coarsening}.json"),
    params:
        config=COMPLETE_SECTIONS,
    script:
        "scripts/complete_scene.py"


rule complete_scan:
    input:
        plan=plan_file,
        fit=rules.building_fit.output[0],
        fidelity=FIDELITY_FILE,
        law=LAW_FILE,
        motion=of_run(rules.floor_motions.output[0]),
    output:
        scan=results("planar/{complete}/{record}_{direction}.csv"),
        plan=results("complete/plans/{complete}_{record}_{direction}.json"),
    benchmark:
        benchmarks("complete_scan_{complete}_{record}_{direction}")
    params:
        config=COMPLETE_SECTIONS,
        settings=lambda w: {
            **{key: RUNS.cfg(w)["ida"][key] for key in ("beyond", "max_pga_g")},
            "amplitude_spread": RUNS.cfg(w)["ensemble"]["amplitude_spread"],
        },
        most=value_of("ida.max_collapse_ranges"),
    script:
        "scripts/complete_scan.py"


use rule ida as complete_ida with:
    input:
        case=curve_scene,
        motion=of_run(rules.floor_motions.output[0]),
        plan=rules.complete_scan.output.plan,
        yade=rules.yade_check.output[0],
        modules=command_code("ida"),
    output:
        curve=results("ida/{complete}/{record}_{direction}.csv"),
    log:
        logs("complete_ida_{complete}_{record}_{direction}"),
    benchmark:
        benchmarks("complete_ida_{complete}_{record}_{direction}")
    params:
        ensemble="",
        journal=results("cache/complete/{complete}_{record}_{direction}.jsonl"),


# A short push of the ground, and then nothing: the building rings.
rule complete_pulse:
    output:
        results("complete/pulse.csv"),
    script:
        "scripts/complete_pulse.py"


rule complete_history:
    input:
        scene=rules.complete_scene.output[0],
        motion=history_motion,
        yade=rules.yade_check.output[0],
        modules=command_code("complete_history"),
    output:
        history=results("complete/histories/{complete}_{coarsening}_{kind}.csv"),
        cost=results("complete/histories/{complete}_{coarsening}_{kind}.json"),
    log:
        logs("complete_history_{complete}_{coarsening}_{kind}"),
    wildcard_constraints:
        kind="linear|ring|apart|level",
    params:
        yade=YADE,
        how=history_options,
    shell:
        "{params.yade} complete_history --scene {input.scene:q} --motion {input.motion:q}"
        " {params.how} --output {output.history:q} --cost {output.cost:q} 2> {log:q}"


rule table_complete_checks:
    input:
        scene=of_run(rules.complete_scene.output[0], complete="CBc", cases=brick_sizes),
        linear=linear_history("linear"),
        ring=linear_history("ring"),
        apart=linear_history("apart"),
        motion=CHECK_MOTION,
    output:
        shown_table("complete_checks", "Complete building", "periods and linear answer"),
    params:
        direction=value_of("complete.check_direction"),
        pga_g=value_of("complete.linear_pga_g"),
    script:
        "scripts/table_complete_checks.py"


rule table_complete_convergence:
    input:
        scenes=of_run(rules.complete_scene.output[0], complete="CB", cases=brick_sizes),
        costs=of_run(rules.complete_history.output.cost, **LEVELS),
        histories=of_run(rules.complete_history.output.history, **LEVELS),
    output:
        shown_table("complete_convergence", "Complete building", "brick size"),
    script:
        "scripts/table_complete_convergence.py"


rule complete_collapse:
    input:
        ida=of_run(
            rules.complete_ida.output[0],
            complete=COMPLETE_MODELS,
            record=RUNS.confirmed,
        ),
        scans=of_run(rules.complete_scan.output.scan, complete=COMPLETE_MODELS),
    output:
        collapse=results("tables/complete_collapse.csv"),
        probability=results("tables/complete_probability.csv"),
    params:
        spread=value_of("ensemble.amplitude_spread"),
    script:
        "scripts/table_complete_collapse.py"


figure_by(
    "studies/building/scripts/figure_complete",
    "complete_ida",
    "Complete building",
    "IDA of the complete building",
    ida=of_run(
        rules.complete_ida.output[0],
        complete=COMPLETE_MODELS,
        record=RUNS.confirmed,
    ),
    scans=all_of(
        of_run(rules.complete_scan.output.scan, complete=COMPLETE_MODELS),
        of_run(rules.planar_ida.output.scan, cases=two_way_curves),
    ),
    facts=of_run(rules.record.output.facts),
    params=dict(spread=value_of("ensemble.amplitude_spread")),
)


rule complete:
    """
    The whole brick building under shaking.
    Costs: 95 min for eight curves; by simulated time.
    Page: docs/complete.md
    """
    input:
        every_run(
            rules.table_complete_checks.output,
            rules.table_complete_convergence.output,
            rules.complete_collapse.output,
            rules.figure_complete.output.png,
        ),
