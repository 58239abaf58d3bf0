# What the base of a rigid façade is worth compared with the elastic wall: ask for `base_compliance`.
from yade_scripts.lists import listed


def of_one_block(run):
    """Models of a run whose façade can be cut into courses: dry, before one-way coupled walls."""
    models = [m for m in RUNS.settings[run]["models"] if MODELS[m].compiled]
    usable = [m for m in models if not (MODELS[m].two_way or MODELS[m].bonded)]
    if not usable:
        stop(f"base_compliance: models = {listed(models)}: expected W1 or W2")
    return usable


table_of("base_compliance", "base_static", static="base_static")


rule base_collapse:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
    output:
        table=results("base/{model}/{record}_{direction}.csv"),
    log:
        logs("base_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("base_{model}_{record}_{direction}")
    params:
        study="base_compliance",
    script:
        "../../scripts/studies/collapse.py"


table_of(
    "base_compliance",
    "base_table",
    tables=of_run(rules.base_collapse.output.table, model=of_one_block),
    table="base_collapse",
    summary="base_summary",
)
figure_of(
    "base_compliance",
    "base_compliance",
    "Records",
    "what the base of a rigid façade is worth",
    caption="Above left: static curves of the 3DEC study's façade. The elastic wall carries half as much"
    " again as the rigid block on E/h and less than the rigid one. Above right: PGA of half collapse"
    " of blocks and of the chosen stack against the stack that stands for the wall, one point a"
    " curve; on the line both are alike. Below: error of half collapse against processor time.",
    static=rules.base_static.output.static,
    table=rules.base_table.output.table,
)


rule base_compliance:
    """
    Static curve and collapse of the elastic wall beside the rigid block on either base.
    Costs: 15 min; by records.
    """
    input:
        every_run(
            rules.base_static.output,
            rules.base_table.output,
            rules.figure_base_compliance.output.png,
        ),
