# Runs side by side: a grid, scenarios, or finished runs by name.


rule compare:
    input:
        f"results/{STUDY.name}/compare/collapse.csv",


rule compare_runs:
    input:
        tables=COMPARE.tables,
        facts=COMPARE.facts,
        modules=code("compare/figure_compare"),
    output:
        table=f"results/{STUDY.name}/compare/collapse.csv",
        png=report(
            f"results/{STUDY.name}/compare/collapse.png",
            caption=caption("compare"),
            category="Answer",
            labels={"run": STUDY.name, "result": "runs side by side"},
        ),
        pdf=f"results/{STUDY.name}/compare/collapse.pdf",
    log:
        f"results/{STUDY.name}/logs/compare_runs.log",
    params:
        differing=COMPARE.differing,
    script:
        "../scripts/compare/figure_compare.py"
