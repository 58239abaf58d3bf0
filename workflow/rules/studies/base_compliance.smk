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
        modules=code("base_compliance/base_static"),
    output:
        results("tables/base_static.csv"),
    log:
        logs("base_static"),
    script:
        "../../scripts/base_compliance/base_static.py"


rule base_collapse:
    input:
        scene=rules.scene.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        modules=code("base_compliance/base_collapse"),
    output:
        results("base/{model}/{record}_{direction}.csv"),
    log:
        logs("base_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("base_{model}_{record}_{direction}")
    params:
        record=lambda w: w.record,
    script:
        "../../scripts/base_compliance/base_collapse.py"


rule base_table:
    input:
        tables=of_run(rules.base_collapse.output[0], model=of_one_block),
        modules=code("base_compliance/base_table"),
    output:
        table=results("tables/base_collapse.csv"),
        summary=results("tables/base_summary.csv"),
    log:
        logs("base_table"),
    script:
        "../../scripts/base_compliance/base_table.py"


rule figure_base_compliance:
    input:
        static=rules.base_static.output[0],
        table=rules.base_table.output.table,
        facts=of_run(rules.record.output.facts),
        modules=code("base_compliance/figure_base_compliance"),
    output:
        **figure("base_compliance", "Records", "what the base of a rigid façade is worth"),
    log:
        logs("figure_base_compliance"),
    script:
        "../../scripts/base_compliance/figure_base_compliance.py"


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
