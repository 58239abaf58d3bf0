# The study row by row: `snakemake --configfile config/scenarios/study.yaml -- study`.
include: "w3.smk"
include: "boundary.smk"


# Rules whose tables and pictures stand on the page; a study's, where its folder is there.
TABLES = ("records_table", "table_building_modes", "table_wme", "table_claims_building")
TABLES += ("free_rocking_table", "beta_fit", "shake_table_table", "table_claims_calibration")
TABLES += ("table_pushover", "ida_collapse", "table_claims")
FIGURES = ("fig01_building", "fig02_modes", "fig03_wme", "fig04_calibration", "fig05_sorrentino")
FIGURES += ("fig06_shawa", "fig07_models", "fig08_w3", "fig09_ida")
OF_SEVERAL = {"table_wme": "wme", "beta_fit": "fit", "ida_collapse": "collapse"}  # its table


def made_by(names):
    """Input function: the table or picture of each of these rules that there is."""

    def files(wildcards):
        present = [getattr(rules, name) for name in names if hasattr(rules, name)]
        outputs = [
            getattr(rule.output, OF_SEVERAL.get(rule.rule.name, "png"), rule.output[0])
            for rule in present
        ]
        return all_of(*(of_run(path, record="RRS228") for path in outputs))(wildcards)

    return files


rule study_page:
    input:
        data=RUNS.find_file("docs/study.yaml"),
        tables=made_by(TABLES),
        figures=made_by(FIGURES),
    output:
        results("study.md"),
    script:
        "scripts/study_page.py"


rule study:
    """
    With `--configfile config/scenarios/study.yaml`: every figure, table and result of the 3DEC study
    compared with this run.
    Costs: 30 min; 11 more where the shake table has its recorded motions.
    Page: docs/study.md
    """
    input:
        every_run(rules.study_page.output),
