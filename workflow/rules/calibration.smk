# Calibration of β: free-rocking study, its law, both validations, an own wall.


rule calibration_cases:
    input:
        wall=CALIBRATION.wall,
        modules=code("calibrate_cases"),
    output:
        CASES,
    log:
        "results/{run}/logs/calibration_cases_{group}.log",
    wildcard_constraints:
        group=r"batch\d+|sensitivity|free_rocking_wall|own_wall",
    params:
        config=CALIBRATION.config,
    script:
        "../scripts/calibrate_cases.py"


rule free_rocking:
    input:
        cases=CASES,
        yade=ancient("results/{run}/yade.txt"),
        modules=study_code("free_rocking"),
    output:
        HISTORIES,
    log:
        "results/{run}/logs/free_rocking_{group}.log",
    benchmark:
        "results/{run}/benchmarks/free_rocking_{group}.tsv"
    params:
        yade=YADE,
    shell:
        "{params.yade} free_rocking --cases {input.cases:q} --output {output:q}"
        " 2> {log:q}"


rule free_rocking_table:
    input:
        cases=CALIBRATION.of_groups(CASES),
        histories=CALIBRATION.of_groups(HISTORIES),
        modules=code("table_free_rocking"),
    output:
        report(
            "results/{run}/tables/free_rocking.csv",
            caption=caption("table_free_rocking"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "rebounds and e_exp (CSV)"},
        ),
    log:
        "results/{run}/logs/free_rocking_table.log",
    script:
        "../scripts/table_free_rocking.py"


rule beta_fit:
    input:
        cases=CALIBRATION.of_groups(CASES),
        histories=CALIBRATION.of_groups(HISTORIES),
        modules=code("calibrate_fit"),
    output:
        walls="results/{run}/tables/beta_walls.csv",
        fit=report(
            "results/{run}/tables/beta_fit.csv",
            caption=caption("table_beta_fit"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "best-fitting β (CSV)"},
        ),
    log:
        "results/{run}/logs/beta_fit.log",
    script:
        "../scripts/calibrate_fit.py"


rule beta_law:
    input:
        "results/{run}/tables/beta_walls.csv",
        modules=code("calibrate_law"),
    output:
        law="results/{run}/calibration/beta_law.json",
        table=report(
            "results/{run}/tables/beta_regression.csv",
            caption=caption("table_beta_regression"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "laws of β (CSV)"},
        ),
    log:
        "results/{run}/logs/beta_law.log",
    script:
        "../scripts/calibrate_law.py"


rule table_claims_calibration:
    input:
        free="results/{run}/tables/free_rocking.csv",
        fits="results/{run}/tables/beta_fit.csv",
        walls="results/{run}/tables/beta_walls.csv",
        modules=code("table_claims_calibration"),
    output:
        report(
            "results/{run}/tables/claims_calibration.csv",
            caption=caption("table_claims_calibration"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "claims of the study's section 3 (CSV)"},
        ),
    log:
        "results/{run}/logs/table_claims_calibration.log",
    params:
        settings=STUDY.params_of("calibration"),
    script:
        "../scripts/table_claims_calibration.py"


rule fig04_calibration:
    input:
        cases="results/{run}/calibration/cases_batch1.json",
        histories="results/{run}/calibration/histories_batch1.npz",
        walls="results/{run}/tables/beta_walls.csv",
        law="results/{run}/calibration/beta_law.json",
        modules=code("fig04_calibration"),
    output:
        png=report(
            "results/{run}/figures/fig04_calibration.png",
            caption=caption("fig04"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "4: parametric study"},
        ),
        pdf="results/{run}/figures/fig04_calibration.pdf",
    log:
        "results/{run}/logs/fig04_calibration.log",
    params:
        settings=STUDY.params_of("calibration"),
    script:
        "../scripts/fig04_calibration.py"


rule wall_beta:
    input:
        cases="results/{run}/calibration/cases_own_wall.json",
        histories="results/{run}/calibration/histories_own_wall.npz",
        law=LAW_FILE,
        modules=code("calibrate_wall"),
    output:
        table="results/{run}/tables/wall_beta.csv",
        png=report(
            "results/{run}/figures/wall_beta.png",
            caption=caption("wall_beta"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "β of this façade"},
        ),
        pdf="results/{run}/figures/wall_beta.pdf",
    log:
        "results/{run}/logs/wall_beta.log",
    params:
        config=STUDY.params_of("calibration", "facade", "return_wall"),
    script:
        "../scripts/calibrate_wall.py"


# `snakemake calibration`: the whole study.
rule calibration:
    input:
        with_pages(STUDY.per_run(CALIBRATION.results)),


# `snakemake --configfile my_facade.yaml -- calibrate_wall`: β of the configuration's own façade.
rule calibrate_wall:
    input:
        STUDY.per_run(CALIBRATION.wall_results),


include: "validation.smk"
