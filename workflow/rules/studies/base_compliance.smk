# What the base of a rigid façade is worth compared with the elastic wall: ask for `base_compliance`.


def of_one_block(run):
    """Models of a run whose façade can be cut into courses: dry, before one-way coupled walls."""
    models = [m for m in RUNS.settings[run]["models"] if MODELS[m].planar]
    found = [m for m in models if not (MODELS[m].two_way or MODELS[m].bonded)]
    if not found:
        stop(f"base_compliance: models = {', '.join(models)}: expected W1 or W2")
    return found


rule base_static:
    input:
        modules=code("studies/table", study="base_compliance"),
    output:
        static=results("tables/base_static.csv"),
    log:
        logs("base_static"),
    params:
        study="base_compliance",
    script:
        "../../scripts/studies/table.py"


rule base_collapse:
    input:
        scene=rules.scene.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        modules=code("studies/collapse", study="base_compliance"),
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


rule base_table:
    input:
        tables=of_run(rules.base_collapse.output.table, model=of_one_block),
        modules=code("studies/table", study="base_compliance"),
    output:
        table=results("tables/base_collapse.csv"),
        summary=results("tables/base_summary.csv"),
    log:
        logs("base_table"),
    params:
        study="base_compliance",
    script:
        "../../scripts/studies/table.py"


rule figure_base_compliance:
    input:
        static=rules.base_static.output.static,
        table=rules.base_table.output.table,
        facts=of_run(rules.record.output.facts),
        modules=code("studies/figure", study="base_compliance"),
    output:
        **figure(
            "base_compliance",
            "Records",
            "what the base of a rigid façade is worth",
            about="study",
        ),
    log:
        logs("figure_base_compliance"),
    params:
        study="base_compliance",
        caption="Left: static curves of the study's façade. The elastic wall carries half as much"
        " again as the rigid block on E/h and less than the rigid one. Right: PGA of half collapse,"
        " rigid block against the stack of courses that it stands for, one point a curve; on the"
        " line both are alike.",
    script:
        "../../scripts/studies/figure.py"


rule base_compliance:
    """
    Static curve and collapse of the elastic wall beside the rigid block on either base.
    Costs: 5 min; by records.
    """
    input:
        every_run(
            rules.base_static.output,
            rules.base_table.output,
            rules.figure_base_compliance.output.png,
        ),
