# Accelerograms: read or generated, baseline treated, measured.
from dataclasses import asdict



def record_row(wildcards):
    return TABLES[wildcards.run][wildcards.record]


def record_file(wildcards):
    """The accelerogram's file; nothing for a surrogate."""
    return record_row(wildcards).path or []


rule record:
    input:
        file=record_file,
        modules=module("workflow/scripts/record.py"),
    output:
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
    params:
        row=lambda w: {k: v for k, v in asdict(record_row(w)).items() if k != "line"},
        table=lambda w: table_path(cfg(w)),
        baseline=lambda w: cfg(w)["baseline"],
        seed=lambda w: cfg(w)["seed"],
    log:
        "results/{run}/logs/record_{record}.log",
    script:
        "../scripts/record.py"


rule records_table:
    input:
        facts=lambda w: [f"results/{w.run}/records/{r}.json" for r in record_names(w.run)],
    output:
        report(
            "results/{run}/tables/records.csv",
            caption=caption("table_records"),
            category="Records",
            labels={"table": "records"},
        ),
    log:
        "results/{run}/logs/records_table.log",
    script:
        "../scripts/table_records.py"
