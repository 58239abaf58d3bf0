# What friction is worth: ask for `friction`.


rule friction_collapse:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
    output:
        table=results("friction/{model}/{record}_{direction}.csv"),
    params:
        study="friction",
        given=lambda w: {"settings": RUNS.cfg(w)["friction"]},
    script:
        "../../scripts/studies/collapse.py"


table_of(
    "friction",
    "friction_table",
    tables=of_run(rules.friction_collapse.output.table, model=RUNS.compiled),
    table="friction",
    summary="friction_summary",
)
figure_of(
    "friction",
    "friction",
    "Records",
    "what friction is worth",
    caption="PGA at which half of the realisations first collapse, by the friction angle of the"
    " façade's joints, over that of the first angle. One line a curve.",
    table=rules.friction_table.output.table,
)


rule friction:
    """What friction is worth.

    Costs: a minute.
    """
    input:
        every_run(rules.friction_table.output, rules.figure_friction.output.png),
