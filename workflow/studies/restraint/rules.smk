# What a roof's load and friction are worth: collapse PGA by planar scans, YADE's realisations on them.


@cache
def roofed_models(run):
    """Models of a run with a planar counterpart; a façade that cannot have a roof ends in one line."""
    from rocking import Case  # slow to load
    from studies.restraint.study import roof

    resolved, models = RUNS.settings[run], RUNS.compiled(run)
    if not models:
        stop(f"restraint: models = {resolved['models']}: expected one with a planar counterpart")
    roofed = roof(resolved["facade"]["height_m"], resolved["restraint"]["loads_kn"][0], 0.0)
    try:
        for model in models:
            Case({**resolved, "model": model}).varied(roofed)
    except configuration.ConfigError as error:
        stop(f"restraint: {error.detail}")
    return models


rule restrain:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
    output:
        table=results("restraint/{model}/{record}_{direction}.csv"),
        plan=results("restraint/{model}/{record}_{direction}.json"),
    log:
        logs("restraint_{model}_{record}_{direction}"),
    params:
        study="restraint",
        given=lambda w: {"settings": RUNS.cfg(w)["restraint"]},
    script:
        "../../scripts/studies/collapse.py"


yade_runs_of(
    "restraint",
    "restrain_yade",
    plan=rules.restrain.output.plan,
    path=results("restraint/{model}/{record}_{direction}_yade.csv"),
)


rule figure_restraint:
    input:
        tables=of_run(rules.restrain.output.table, model=roofed_models),
        yade=of_run(rules.restrain_yade.output[0], model=roofed_models),
        record=rules.own_record.output.facts,
        facts=rules.own_record.output.facts,
    output:
        png=shown(
            results("restraint/{record}_{direction}.png"),
            "study",
            "Strengthening",
            "roof, {record} {direction}",
        ),
        pdf=results("restraint/{record}_{direction}.pdf"),
    params:
        study="restraint",
        caption="Collapse PGA (half of the perturbed histories of the planar solver fall; band: 10"
        " to 90 %) against the friction of a roof at the top, for several loads of it, compared with"
        " the façade without. Stars: realisations in YADE, below and above collapse under the"
        " largest load; filled where all fell, with their share where some did. No point: not felled"
        " up to `ida.max_pga_g`. Numerical scatter of one façade under one motion.",
    script:
        "../../scripts/studies/figure.py"


rule restraint:
    """
    Collapse against load and friction of a roof.
    Costs: minutes; by loads and frictions.
    Page: docs/floors.md
    """
    input:
        every_run(rules.figure_restraint.output.png),
