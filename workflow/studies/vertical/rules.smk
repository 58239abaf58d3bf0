# What vertical motion changes in collapse: ask for `vertical`, with records that have one.


def both_motions(wildcards):
    """Files of both motions; a record without a vertical one ends the workflow."""
    try:
        RUNS.check_vertical(wildcards.run, "vertical", [wildcards.record])
    except configuration.ConfigError as error:
        stop(error.detail)
    row = RUNS.record_row(wildcards)
    return list(dict.fromkeys([row.path, row.vertical_path]))


rule vertical_collapse:
    input:
        files=both_motions,
        record=of_run(rules.record.output.record),
        cases=of_run(rules.facade_case.output[0], model=RUNS.compiled),
    output:
        table=results("vertical/{record}.csv"),
    log:
        logs("vertical_{record}"),
    benchmark:
        benchmarks("vertical_{record}")
    params:
        study="vertical",
        given=lambda w: {
            "station": RUNS.station(w),
            "table": RUNS.table_path(w.run),
            "treatment": SHARED.treatment(w.run),
        },
        directions=value_of("directions"),
    script:
        "../../scripts/studies/collapse.py"


table_of(
    "vertical",
    "vertical_ratios",
    tables=of_run(rules.vertical_collapse.output.table),
    table="vertical",
    summary="vertical_ratios",
)
figure_of(
    "vertical",
    "vertical",
    "Records",
    "what vertical motion changes",
    caption="What the vertical motion of ground and building changes: PGA at which half of a"
    " curve's realisations first collapse, with over without it. Left: distribution over"
    " records and directions; grey, a hundredth of the vertical motion: what the scatter of"
    " histories near collapse makes alone. Right: by how strong the vertical motion is.",
    table=rules.vertical_ratios.output.table,
)


rule vertical:
    """
    What the vertical motion changes.
    Costs: 3 to 20 min; by records.
    Page: docs/motions.md
    """
    input:
        every_run(rules.vertical_ratios.output, rules.figure_vertical.output.png),
