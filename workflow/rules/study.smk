# The study row by row: `snakemake --configfile config/scenarios/five_models.yaml -- study`.
STUDY_TABLES = [
    rules.records_table.output[0],
    rules.table_building_modes.output[0],
    rules.table_wme.output.wme,
    rules.table_claims_building.output[0],
    rules.free_rocking_table.output[0],
    rules.beta_fit.output.fit,
    rules.shake_table_table.output[0],
    rules.table_claims_calibration.output[0],
    rules.table_pushover.output[0],
    rules.ida_collapse.output.collapse,
    rules.table_claims.output[0],
]
STUDY_FIGURES = [
    rules.fig01_building.output.png,
    rules.fig02_modes.output.png,
    expand(rules.fig03_wme.output.png, record="RRS228", allow_missing=True),
    rules.fig04_calibration.output.png,
    rules.fig05_sorrentino.output.png,
    rules.fig06_shawa.output.png,
    rules.fig07_models.output.png,
    rules.fig08_w3.output.png,
    rules.fig09_ida.output.png,
]


rule study_page:
    input:
        data=RUNS.find_file("docs/study.yaml"),
        tables=STUDY_TABLES,
        figures=STUDY_FIGURES,
    output:
        results("study.md"),
    script:
        "../scripts/study/study_page.py"


rule study:
    """
    With `--configfile config/scenarios/five_models.yaml`: every figure, table and result of the study
    compared with this run.
    Costs: 30 min; 11 more where the shake table has its recorded motions.
    Page: docs/study.md
    """
    input:
        every_run(rules.study_page.output),
