# The study row by row: `snakemake --configfile config/scenarios/five_models.yaml -- study`.
STUDY_TABLES = (
    "records",
    "building_modes",
    "wme",
    "claims_building",
    "free_rocking",
    "beta_fit",
    "shake_table",
    "claims_calibration",
    "pushover",
    "ida_collapse",
    "claims",
)


rule study_page:
    input:
        data=STUDY.beside("docs/study.yaml"),
        tables=expand(
            "results/{run}/tables/{table}.csv", table=STUDY_TABLES, allow_missing=True
        ),
        modules=code("study/study_page"),
    output:
        "results/{run}/study.md",
    log:
        "results/{run}/logs/study_page.log",
    script:
        "../scripts/study/study_page.py"


rule study:
    input:
        STUDY.per_run(lambda run: [f"results/{run}/study.md"]),
