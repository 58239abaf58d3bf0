# Accelerograms: read or generated, baseline treated, measured.
rule record:
    input:
        file=of_alike(RUNS.record_file),
        vertical=of_alike(lambda w: RUNS.record_row(w).vertical_path or []),
        surrogates=of_alike(RUNS.surrogate_parameters),
    output:
        record=shared("records/{record}.csv"),
        facts=shared("records/{record}.json"),
    log:
        shared("logs/record_{record}.log"),
    params:
        row=of_alike(lambda w: {k: v for k, v in asdict(RUNS.record_row(w)).items() if k != "line"}),
        table=of_alike(lambda w: RUNS.table_path(w.run)),
        how=of_alike(lambda w: SHARED.treatment(w.run)),
    script:
        "../scripts/records/record.py"


rule figure_record:
    input:
        record=rules.record.output.record,
        facts=rules.record.output.facts,
    output:
        png=report(
            shared("figures/record_{record}.png"),
            caption=caption("record"),
            category="Records",
            labels=lambda w: {
                "run": SHARED.label(w),
                "record": w.record,
                "result": "accelerogram",
            },
        ),
        pdf=shared("figures/record_{record}.pdf"),
    log:
        shared("logs/figure_record_{record}.log"),
    script:
        "../scripts/records/figure_record.py"


rule records_table:
    input:
        facts=of_run(rules.record.output.facts),
    output:
        results("tables/records.csv"),
    script:
        "../scripts/records/table_records.py"


rule records_check:
    input:
        files=RUNS.record_files,
        table=lambda w: RUNS.table_path(w.run),
    output:
        results("tables/records_check.csv"),
    params:
        table=lambda w: RUNS.table_path(w.run),
        records=lambda w: RUNS.records[w.run],
        baseline=value_of("baseline"),
        seed=value_of("seed"),
        reach_g=lambda w: reach_g(RUNS.cfg(w)),
    script:
        "../scripts/records/check_records.py"


rule check:
    """
    What is wrong or doubtful with each record: `tables/records_check.csv`.
    Costs: seconds.
    """
    input:
        every_run(rules.records_check.output),
