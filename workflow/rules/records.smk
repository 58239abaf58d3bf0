# Accelerograms: read or generated, baseline treated, measured.
rule record:
    input:
        file=record_file,
        surrogates=surrogate_parameters,
        modules=package("workflow/rocking/records"),
    output:
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
    log:
        "results/{run}/logs/record_{record}.log",
    params:
        row=lambda w: {k: v for k, v in asdict(record_row(w)).items() if k != "line"},
        table=lambda w: table_path(cfg(w)),
        baseline=lambda w: cfg(w)["baseline"],
        seed=lambda w: cfg(w)["seed"],
    script:
        "../scripts/record.py"


rule records_table:
    input:
        facts=record_facts,
    output:
        "results/{run}/tables/records.csv",
    log:
        "results/{run}/logs/records_table.log",
    script:
        "../scripts/table_records.py"
