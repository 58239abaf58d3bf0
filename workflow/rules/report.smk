# Pages of the report: tables in readable form, provenance of the records, run times.


rule report_table:
    input:
        table="results/{run}/tables/{table}.csv",
        style=REPORT_STYLE,
        modules=code("report_table"),
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
        "../scripts/report_table.py"


rule report_provenance:
    input:
        facts=STUDY.record_facts,
        style=REPORT_STYLE,
        modules=code("report_provenance"),
    output:
        report(
            "results/{run}/report/provenance.html",
            caption=caption("provenance"),
            category="Records",
            labels={"run": "{run}", "result": "provenance of every record"},
        ),
    log:
        "results/{run}/logs/report_provenance.log",
    params:
        about=lambda w: {
            name: STUDY.tables[w.run][name].about for name in STUDY.records[w.run]
        },
        table=lambda w: STUDY.cfg(w)["records_table"],
    script:
        "../scripts/report_provenance.py"


# The table names its own columns of time, which differ from one execution to the next.
rule table_run_times:
    input:
        ida=lambda w: STUDY.ida_tables(w.run),
        modules=code("table_run_times"),
    output:
        "results/{run}/tables/run_times.csv",
    log:
        "results/{run}/logs/table_run_times.log",
    params:
        benchmarks=lambda w: f"results/{w.run}/benchmarks",
    script:
        "../scripts/table_run_times.py"
