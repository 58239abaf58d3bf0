# Pages of the report: tables in readable form, provenance of the records, run times.


# What the report begins with, see workflow/Snakefile.
rule report_summary:
    input:
        ida=lambda w: STUDY.ida_tables(w.run),
        records="results/{run}/tables/records.csv",
        collapse="results/{run}/tables/ida_collapse.csv",
        figure="results/{run}/figures/fig09_ida.png",
        style=REPORT_STYLE,
        modules=code("report/report_summary"),
    output:
        page=shown(
            "results/{run}/report/summary.html",
            "summary",
            "Answer",
            "at what shaking it falls",
        ),
        first="results/{run}/report/summary.rst",
        factors="results/{run}/tables/scale_factors.csv",
    log:
        "results/{run}/logs/report_summary.log",
    params:
        facade=STUDY.params_of("facade"),
        models=lambda w: [f"{m}, {MODELS[m].meaning}" for m in STUDY.cfg(w)["models"]],
    script:
        "../scripts/report/report_summary.py"


rule report_table:
    input:
        table="results/{run}/tables/{table}.csv",
        style=REPORT_STYLE,
        modules=code("report/report_table"),
    output:
        report(
            "results/{run}/report/{table}.html",
            caption=caption("report_table"),
            category=lambda w: REPORT_TABLES[w.table][0],
            labels=lambda w: {"run": w.run, "result": REPORT_TABLES[w.table][1]},
        ),
    log:
        "results/{run}/logs/report_table_{table}.log",
    params:
        title=lambda w: REPORT_TABLES[w.table][1],
        text=lambda w: REPORT_TABLES[w.table][2],
    script:
        "../scripts/report/report_table.py"


rule report_provenance:
    input:
        facts=STUDY.record_facts,
        style=REPORT_STYLE,
        modules=code("report/report_provenance"),
    output:
        shown(
            "results/{run}/report/provenance.html",
            "provenance",
            "Records",
            "provenance of every record",
        ),
    log:
        "results/{run}/logs/report_provenance.log",
    params:
        table=lambda w: STUDY.cfg(w)["records_table"],
    script:
        "../scripts/report/report_provenance.py"


# The table names its own columns of time, which differ from one execution to the next.
rule table_run_times:
    input:
        ida=lambda w: STUDY.ida_tables(w.run),
        modules=code("report/table_run_times"),
    output:
        "results/{run}/tables/run_times.csv",
    log:
        "results/{run}/logs/table_run_times.log",
    params:
        benchmarks=lambda w: f"results/{w.run}/benchmarks",
    script:
        "../scripts/report/table_run_times.py"
