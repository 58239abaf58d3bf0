# Where the methods fail, as a map under the run's first record: ask for `limits`.


rule limits_table:
    input:
        record=of_run(rules.own_record.output.record, record=lambda run: RUNS.records[run][0]),
        modules=code("accuracy/limits"),
    output:
        results("tables/limits.csv"),
    log:
        logs("limits"),
    benchmark:
        benchmarks("limits")
    params:
        direction=lambda w: RUNS.cfg(w)["directions"][0],
    script:
        "../../scripts/accuracy/limits.py"


rule figure_limits:
    input:
        table=rules.limits_table.output[0],
        facts=of_run(rules.own_record.output.facts, record=lambda run: RUNS.records[run][0]),
        modules=code("accuracy/figure_limits"),
    output:
        **figure("limits", "Accuracy and stability", "where the methods fail"),
    log:
        logs("figure_limits"),
    script:
        "../../scripts/accuracy/figure_limits.py"


rule limits:
    """
    Where the methods fail, over height, thickness, β, friction, T1, gap, E, masses and records.
    Costs: 3 min.
    """
    input:
        every_run(rules.limits_table.output, rules.figure_limits.output.png),
