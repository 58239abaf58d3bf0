# Accelerograms: read or generated, baseline treated, measured.
rule record:
    input:
        file=SHARED.of(STUDY.record_file),
        vertical=SHARED.of(lambda w: STUDY.record_row(w).vertical_path or []),
        surrogates=SHARED.of(STUDY.surrogate_parameters),
        modules=code("records/record"),
    output:
        record="results/.shared/{motions}/records/{record}.csv",
        facts="results/.shared/{motions}/records/{record}.json",
    log:
        "results/.shared/{motions}/logs/record_{record}.log",
    params:
        row=SHARED.of(
            lambda w: {
                k: v for k, v in asdict(STUDY.record_row(w)).items() if k != "line"
            }
        ),
        table=SHARED.of(lambda w: STUDY.table_path(w.run)),
        how=SHARED.of(lambda w: SHARED.treatment(w.run)),
    script:
        "../scripts/records/record.py"


rule records_table:
    input:
        facts=STUDY.record_facts,
        modules=code("records/table_records"),
    output:
        "results/{run}/tables/records.csv",
    log:
        "results/{run}/logs/records_table.log",
    script:
        "../scripts/records/table_records.py"


rule check:
    input:
        STUDY.per_run(lambda run: [f"results/{run}/tables/records_check.csv"]),


rule records_check:
    input:
        files=STUDY.record_files,
        table=lambda w: STUDY.table_path(w.run),
        modules=code("records/check_records"),
    output:
        "results/{run}/tables/records_check.csv",
    log:
        "results/{run}/logs/records_check.log",
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        baseline=lambda w: STUDY.cfg(w)["baseline"],
        seed=lambda w: STUDY.cfg(w)["seed"],
    script:
        "../scripts/records/check_records.py"
