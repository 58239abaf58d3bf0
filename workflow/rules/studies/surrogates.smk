# How far surrogates stand for recorded motions: collapse of both by the same scans; and how far
# draws of one surrogate differ. Ask for `surrogates`.


def has_recordings(run):
    """Whether a run has a record with a file of its own."""
    return any(RUNS.tables[run][name].path for name in RUNS.records[run])


rule surrogate_collapse:
    input:
        record=rules.own_record.output.record,
        parameters=RUNS.surrogate_parameters,
        scenes=of_run(rules.scene.output[0], model=["W1", "W2"]),
        modules=code("surrogates/surrogate_collapse"),
    output:
        results("surrogates/{record}.csv"),
    log:
        logs("surrogates_{record}"),
    benchmark:
        benchmarks("surrogates_{record}")
    params:
        surrogates=value_of("surrogates"),
        table=lambda w: RUNS.table_path(w.run),
        seed=value_of("seed"),
        directions=value_of("directions"),
        station=RUNS.station,
    script:
        "../../scripts/surrogates/surrogate_collapse.py"


rule surrogate_trust:
    input:
        tables=of_run(rules.surrogate_collapse.output[0]),
        modules=code("surrogates/surrogate_trust"),
    output:
        table=results("tables/surrogates.csv"),
        scatter=results("tables/surrogate_scatter.csv"),
        summary=results("tables/surrogate_trust.csv"),
    log:
        logs("surrogate_trust"),
    script:
        "../../scripts/surrogates/surrogate_trust.py"


rule figure_surrogate_trust:
    input:
        table=rules.surrogate_trust.output.table,
        summary=rules.surrogate_trust.output.summary,
        facts=of_run(rules.record.output.facts),
        modules=code("surrogates/figure_surrogate_trust"),
    output:
        **figure("surrogate_trust", "Records", "surrogates compared with their records"),
    log:
        logs("figure_surrogate_trust"),
    script:
        "../../scripts/surrogates/figure_surrogate_trust.py"


rule figure_surrogate_scatter:
    input:
        table=rules.surrogate_trust.output.table,
        facts=of_run(rules.record.output.facts),
        modules=code("surrogates/figure_surrogate_scatter"),
    output:
        **figure("surrogate_scatter", "Records", "draws of surrogates"),
    log:
        logs("figure_surrogate_scatter"),
    script:
        "../../scripts/surrogates/figure_surrogate_scatter.py"


rule surrogates:
    """
    What a surrogate in place of its record changes.
    Costs: 3 to 20 min; by records.
    Page: docs/motions.md
    """
    input:
        every_run(
            rules.surrogate_trust.output.table,
            rules.surrogate_trust.output.scatter,
            where(
                has_recordings,
                rules.surrogate_trust.output.summary,
                rules.figure_surrogate_trust.output.png,
            ),
            where(
                lambda run: RUNS.settings[run]["surrogates"]["draws"] > 1,
                rules.figure_surrogate_scatter.output.png,
            ),
        ),
