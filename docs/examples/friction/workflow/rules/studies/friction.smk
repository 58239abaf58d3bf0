# What friction is worth: ask for `friction`.


rule friction_collapse:
    input:
        scene=rules.scene.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        modules=code("studies/collapse", study="friction"),
    output:
        table=results("friction/{model}/{record}_{direction}.csv"),
    log:
        logs("friction_{model}_{record}_{direction}"),
    params:
        study="friction",
        given=lambda w: {"settings": RUNS.cfg(w)["friction"]},
    script:
        "../../scripts/studies/collapse.py"


rule friction_table:
    input:
        tables=of_run(rules.friction_collapse.output.table, model=RUNS.planar),
        modules=code("studies/table", study="friction"),
    output:
        table=results("tables/friction.csv"),
        summary=results("tables/friction_summary.csv"),
    log:
        logs("friction_table"),
    params:
        study="friction",
    script:
        "../../scripts/studies/table.py"


rule figure_friction:
    input:
        table=rules.friction_table.output.table,
        facts=of_run(rules.record.output.facts),
        modules=code("studies/figure", study="friction"),
    output:
        **figure("friction", "Records", "what friction is worth", about="study"),
    log:
        logs("figure_friction"),
    params:
        study="friction",
        caption="PGA at which half of the realisations first collapse, by the friction angle of the"
        " façade's joints, over that of the first angle. One line a curve.",
    script:
        "../../scripts/studies/figure.py"


rule friction:
    """What friction is worth.

    Costs: a minute.
    """
    input:
        every_run(rules.friction_table.output, rules.figure_friction.output.png),
