# Pages of the report: tables in readable form, provenance of the records, run times.


# What the report begins with, see workflow/Snakefile.
rule report_summary:
    input:
        ida=of_run(rules.ida.output[0], cases=RUNS.by_yade),
        records=rules.records_table.output[0],
        collapse=rules.ida_collapse.output.collapse,
        figure=rules.fig09_ida.output.png,
        style=REPORT_STYLE,
    output:
        page=shown(
            results("report/summary.html"),
            "summary",
            "Answer",
            "at what shaking it falls",
        ),
        first=results("report/summary.rst"),
        factors=results("tables/scale_factors.csv"),
    params:
        facade=RUNS.params_of("facade"),
        models=lambda w: [f"{m}, {MODELS[m].meaning}" for m in RUNS.cfg(w)["models"]],
    script:
        "../scripts/report/report_summary.py"


rule report_table:
    input:
        table=results("tables/{table}.csv"),
        style=REPORT_STYLE,
    output:
        report(
            results("report/{table}.html"),
            caption=caption("report_table"),
            category=lambda w: REPORT_TABLES[w.table]["category"],
            labels=lambda w: {"run": w.run, "result": REPORT_TABLES[w.table]["label"]},
        ),
    params:
        title=lambda w: REPORT_TABLES[w.table]["label"],
        text=lambda w: REPORT_TABLES[w.table]["text"],
    script:
        "../scripts/report/report_table.py"


rule report_provenance:
    input:
        facts=of_run(rules.record.output.facts),
        style=REPORT_STYLE,
    output:
        shown(
            results("report/provenance.html"),
            "provenance",
            "Records",
            "provenance of every record",
        ),
    params:
        table=value_of("records_table"),
    script:
        "../scripts/report/report_provenance.py"


# The table names its own columns of time, which differ from one execution to the next.
rule table_run_times:
    input:
        ida=of_run(rules.ida.output[0], cases=RUNS.by_yade),
        ensembles=of_run(rules.ida.output.ensemble, cases=RUNS.by_yade),
    output:
        results("tables/run_times.csv"),
    params:
        benchmarks=results("benchmarks"),
    script:
        "../scripts/report/table_run_times.py"
