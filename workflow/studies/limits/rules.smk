# Where the methods fail, as a map under the run's first record: ask for `limits`.


rule limits_table:
    input:
        record=of_run(rules.own_record.output.record, record=lambda run: RUNS.records[run][0]),
    output:
        results("tables/limits.csv"),
    log:
        logs("limits"),
    benchmark:
        benchmarks("limits")
    params:
        direction=lambda w: RUNS.cfg(w)["directions"][0],
    script:
        "scripts/limits_table.py"


figure_of(
    "limits",
    "limits",
    "Accuracy and stability",
    "where the methods fail",
    caption="Where the methods fail: both planar solvers on one cell each, at half and at 0.8 of"
    " its lowest collapse. What the words mean stands in workflow/studies/limits/page.md; the"
    " table ``tables/limits.csv`` has the reason of each cell.",
    facts=of_run(rules.own_record.output.facts, record=lambda run: RUNS.records[run][0]),
    table=rules.limits_table.output[0],
)


rule limits:
    """
    Where the methods fail, over height, thickness, β, friction, T1, gap, E, masses and records.
    Costs: 3 min.
    """
    input:
        every_run(rules.limits_table.output, rules.figure_limits.output.png),
