# Calibration of β: free-rocking study, its law, both validations, an own wall.
from studies.calibration import FREE_ROCKING_HIGH_S, FREE_ROCKING_LOW_S


def groups(run):
    """Parts of the free-rocking study, a job each."""
    settings = RUNS.settings[run]["calibration"]
    count = len(settings["thickness_m"]) * len(settings["e_mpa"])
    batches = [f"batch{i}" for i in range(1, count + 1)]
    return [*batches, "sensitivity", "free_rocking_wall"]


def tested_wall(wildcards):
    """File of the tested wall, for the part that has one."""
    if wildcards.group != "free_rocking_wall":
        return []
    return RUNS.find_file(RUNS.cfg(wildcards)["calibration"]["free_rocking_wall"])


def cases_settings(wildcards):
    """What a part depends on: an own wall is the configuration's, the study brings its own."""
    sections = ("facade", "return_wall", "smdof", "numerics")
    return RUNS.params_of("calibration", *(sections if wildcards.group == "own_wall" else ()))(
        wildcards
    )


def is_studied(run):
    """Whether the walls and values of β are those that the study makes claims of."""
    settings = RUNS.settings[run]["calibration"]
    values = {*FREE_ROCKING_LOW_S, *FREE_ROCKING_HIGH_S}
    tested = Path(settings["free_rocking_wall"]).stem == "sorrentino"
    return tested and values <= set(settings["free_rocking_beta_s"])


rule calibration_cases:
    input:
        wall=tested_wall,
    output:
        results("calibration/cases_{group}.json"),
    wildcard_constraints:
        group=r"batch\d+|sensitivity|free_rocking_wall|own_wall",
    params:
        config=cases_settings,
    script:
        "scripts/calibrate_cases.py"


walls_of(
    "free_rocking",
    cases=rules.calibration_cases.output[0],
    path=results("calibration/histories_{group}.npz"),
)


rule free_rocking_table:
    input:
        cases=of_run(rules.calibration_cases.output[0], group=groups),
        histories=of_run(rules.free_rocking.output[0], group=groups),
    output:
        shown_table("free_rocking", "Calibration of the damping", "rebounds and e_exp"),
    script:
        "scripts/table_free_rocking.py"


rule beta_fit:
    input:
        cases=of_run(rules.calibration_cases.output[0], group=groups),
        histories=of_run(rules.free_rocking.output[0], group=groups),
    output:
        walls=results("tables/beta_walls.csv"),
        fit=shown_table("beta_fit", "Calibration of the damping", "best-fitting β"),
    script:
        "scripts/calibrate_fit.py"


rule beta_law:
    input:
        walls=rules.beta_fit.output.walls,
        others=ancient(LAW_FILE),  # the law of the other base stays as it is
    output:
        law=results("calibration/beta_law.json"),
        table=shown_table("beta_regression", "Calibration of the damping", "laws of β"),
    params:
        base=value_of("calibration.base"),
    script:
        "scripts/calibrate_law.py"


rule table_claims_calibration:
    input:
        free=rules.free_rocking_table.output[0],
        fits=rules.beta_fit.output.fit,
        walls=rules.beta_fit.output.walls,
    output:
        shown_table(
            "claims_calibration",
            "Calibration of the damping",
            "claims of the 3DEC study's section 3",
        ),
    params:
        settings=RUNS.params_of("calibration"),
    script:
        "scripts/table_claims_calibration.py"


figure_by(
    "studies/calibration/scripts/fig04_calibration",
    "fig04_calibration",
    "Calibration of the damping",
    "4: parametric study",
    cases=of_run(rules.calibration_cases.output[0], group="batch1"),
    histories=of_run(rules.free_rocking.output[0], group="batch1"),
    walls=rules.beta_fit.output.walls,
    law=rules.beta_law.output.law,
    params=dict(settings=RUNS.params_of("calibration")),
)


rule wall_beta:
    input:
        cases=of_run(rules.calibration_cases.output[0], group="own_wall"),
        histories=of_run(rules.free_rocking.output[0], group="own_wall"),
        law=LAW_FILE,
    output:
        **figure("wall_beta", "Calibration of the damping", "β of this façade"),
        table=results("tables/wall_beta.csv"),
    params:
        config=RUNS.params_of("calibration", "facade", "return_wall"),
    script:
        "scripts/calibrate_wall.py"


rule calibrate_wall:
    """
    β of the configuration's own wall, with its band.
    Costs: a minute.
    """
    input:
        every_run(rules.wall_beta.output.table, rules.wall_beta.output.png),


include: "shake_tables.smk"


rule calibration:
    """
    β of the contacts: what an impact leaves, the β that fits, its law, Figures 4, 5, 6.
    Costs: minutes; by walls.
    """
    input:
        every_run(
            rules.free_rocking_table.output,
            rules.beta_fit.output,
            rules.beta_law.output.table,
            rules.shake_table_table.output,
            where(is_studied, rules.table_claims_calibration.output),
            rules.fig04_calibration.output.png,
            rules.fig05_sorrentino.output.png,
            rules.fig06_shawa.output.png,
        ),
