# How far surrogates stand for recorded motions: collapse of both by the same scans. Ask for `surrogates`.


def has_recordings(run):
    """Whether a run has a record with a file of its own."""
    return any(RUNS.tables[run][name].path for name in RUNS.records[run])


rule surrogate_collapse:
    input:
        record=rules.own_record.output.record,
        parameters=RUNS.surrogate_parameters,
        cases=of_run(rules.facade_case.output[0], model=["W1", "W2"]),
    output:
        table=results("surrogates/{record}.csv"),
    log:
        logs("surrogates_{record}"),
    benchmark:
        benchmarks("surrogates_{record}")
    params:
        study="surrogates",
        given=lambda w: {
            "station": RUNS.station(w),
            "settings": RUNS.cfg(w)["surrogates"],
            "table": RUNS.table_path(w.run),
            "seed": RUNS.cfg(w)["seed"],
        },
        directions=value_of("directions"),
    script:
        "../../scripts/studies/collapse.py"


table_of(
    "surrogates",
    "surrogate_trust",
    tables=of_run(rules.surrogate_collapse.output.table),
    table="surrogates",
    summary="surrogate_trust",
)
figure_of(
    "surrogates",
    "surrogate_trust",
    "Records",
    "surrogates compared with their records",
    caption="How far a surrogate stands for its record. Top: PGA of collapse under the"
    " surrogate over that under the record (first PGA around which half of a scan falls), as a"
    " distribution over records and directions; numbers: its median and the standard deviation"
    " of its logarithm. Bottom: logarithm to base 2 of the ratio between the two directions. A"
    " surrogate that keeps the weak side lies in the first or third quadrant; from peaks alone,"
    " that is chance.",
    table=rules.surrogate_trust.output.table,
    summary=rules.surrogate_trust.output.summary,
)


rule surrogates:
    """
    What a surrogate in place of its record changes.
    Costs: 3 to 20 min; by records.
    Page: docs/motions.md
    """
    input:
        every_run(
            rules.surrogate_trust.output.table,
            where(
                has_recordings,
                rules.surrogate_trust.output.summary,
                rules.figure_surrogate_trust.output.png,
            ),
        ),
