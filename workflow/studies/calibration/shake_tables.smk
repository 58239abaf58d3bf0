# The fitted law against both tested walls.


def shake_table(key):
    """Input function: a file of the shake-table tests."""
    return lambda w: RUNS.find_file(RUNS.cfg(w)["calibration"][f"shake_table_{key}"])


def shake_table_files(wildcards):
    """Record files of the shake-table motions; none for surrogates."""
    try:
        rows = read_table(shake_table("records")(wildcards))
    except RecordError as error:
        stop(error)
    return [row.path for row in rows.values() if row.path]


figure_by(
    "studies/calibration/scripts/fig05_sorrentino",
    "fig05_sorrentino",
    "Calibration of the damping",
    "5: free rocking of the Sorrentino wall",
    cases=of_run(rules.calibration_cases.output[0], group="free_rocking_wall"),
    histories=of_run(rules.free_rocking.output[0], group="free_rocking_wall"),
    law=rules.beta_law.output.law,
    params=dict(settings=RUNS.params_of("calibration")),
)


rule shake_table_tests:
    input:
        wall=shake_table("wall"),
        table=shake_table("records"),
        records=shake_table_files,
        fidelity=FIDELITY_FILE,
        law=rules.beta_law.output.law,
    output:
        tests=results("calibration/shake_table_tests.json"),
        motions=directory(results("calibration/shake_table_motions")),
    params:
        settings=RUNS.params_of("calibration"),
        baseline=value_of("baseline"),
        seed=value_of("seed"),
    script:
        "scripts/calibrate_shake_table.py"


walls_of(
    "shake_table",
    cases=rules.shake_table_tests.output.tests,
    path=results("calibration/shake_table_histories.npz"),
    motions=rules.shake_table_tests.output.motions,
)


rule shake_table_table:
    input:
        tests=rules.shake_table_tests.output.tests,
        histories=rules.shake_table.output[0],
    output:
        shown_table("shake_table", "Calibration of the damping", "shake-table runs"),
    script:
        "scripts/table_shake_table.py"


figure_by(
    "studies/calibration/scripts/fig06_shawa",
    "fig06_shawa",
    "Calibration of the damping",
    "6: shake-table tests of the Shawa wall",
    tests=rules.shake_table_tests.output.tests,
    histories=rules.shake_table.output[0],
)
