# Calibration of β: free-rocking study, its law, both validations, an own wall.


rule calibration_cases:
    input:
        wall=CALIBRATION.wall,
        modules=code("calibration/calibrate_cases"),
    output:
        CASES,
    log:
        "results/{run}/logs/calibration_cases_{group}.log",
    wildcard_constraints:
        group=r"batch\d+|sensitivity|free_rocking_wall|own_wall",
    params:
        config=CALIBRATION.config,
    script:
        "../scripts/calibration/calibrate_cases.py"


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
        modules=code("calibration/table_free_rocking"),
    output:
        shown(
            "results/{run}/tables/free_rocking.csv",
            "table_free_rocking",
            "Calibration of the damping",
            "rebounds and e_exp (CSV)",
        ),
    log:
        "results/{run}/logs/free_rocking_table.log",
    script:
        "../scripts/calibration/table_free_rocking.py"


rule beta_fit:
    input:
        cases=CALIBRATION.of_groups(CASES),
        histories=CALIBRATION.of_groups(HISTORIES),
        modules=code("calibration/calibrate_fit"),
    output:
        walls="results/{run}/tables/beta_walls.csv",
        fit=shown(
            "results/{run}/tables/beta_fit.csv",
            "table_beta_fit",
            "Calibration of the damping",
            "best-fitting β (CSV)",
        ),
    log:
        "results/{run}/logs/beta_fit.log",
    script:
        "../scripts/calibration/calibrate_fit.py"


rule beta_law:
    input:
        "results/{run}/tables/beta_walls.csv",
        modules=code("calibration/calibrate_law"),
    output:
        law="results/{run}/calibration/beta_law.json",
        table=shown(
            "results/{run}/tables/beta_regression.csv",
            "table_beta_regression",
            "Calibration of the damping",
            "laws of β (CSV)",
        ),
    log:
        "results/{run}/logs/beta_law.log",
    script:
        "../scripts/calibration/calibrate_law.py"


rule table_claims_calibration:
    input:
        free="results/{run}/tables/free_rocking.csv",
        fits="results/{run}/tables/beta_fit.csv",
        walls="results/{run}/tables/beta_walls.csv",
        modules=code("calibration/table_claims_calibration"),
    output:
        shown(
            "results/{run}/tables/claims_calibration.csv",
            "table_claims_calibration",
            "Calibration of the damping",
            "claims of the study's section 3 (CSV)",
        ),
    log:
        "results/{run}/logs/table_claims_calibration.log",
    params:
        settings=STUDY.params_of("calibration"),
    script:
        "../scripts/calibration/table_claims_calibration.py"


rule fig04_calibration:
    input:
        cases="results/{run}/calibration/cases_batch1.json",
        histories="results/{run}/calibration/histories_batch1.npz",
        walls="results/{run}/tables/beta_walls.csv",
        law="results/{run}/calibration/beta_law.json",
        modules=code("calibration/fig04_calibration"),
    output:
        **figure(
            "fig04_calibration",
            "Calibration of the damping",
            "4: parametric study",
            about="fig04",
        ),
    log:
        "results/{run}/logs/fig04_calibration.log",
    params:
        settings=STUDY.params_of("calibration"),
    script:
        "../scripts/calibration/fig04_calibration.py"


rule wall_beta:
    input:
        cases="results/{run}/calibration/cases_own_wall.json",
        histories="results/{run}/calibration/histories_own_wall.npz",
        law=LAW_FILE,
        modules=code("calibration/calibrate_wall"),
    output:
        **figure("wall_beta", "Calibration of the damping", "β of this façade"),
        table="results/{run}/tables/wall_beta.csv",
    log:
        "results/{run}/logs/wall_beta.log",
    params:
        config=STUDY.params_of("calibration", "facade", "return_wall"),
    script:
        "../scripts/calibration/calibrate_wall.py"


# `snakemake calibration`: the whole study.
rule calibration:
    input:
        with_pages(STUDY.per_run(CALIBRATION.results)),


# `snakemake --configfile my_facade.yaml -- calibrate_wall`: β of the configuration's own façade.
rule calibrate_wall:
    input:
        STUDY.per_run(CALIBRATION.wall_results),


include: "shake_tables.smk"
