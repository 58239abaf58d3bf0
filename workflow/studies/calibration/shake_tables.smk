# The fitted law against both tested walls, and what the choice of the law changes in an IDA.

CHOICE_RECORD = RUNS.key("calibration.choice_record")


def choices(run):
    """Wildcards of the curves that compare the laws."""
    return [
        {"model": model, "direction": direction, "law": law}
        for model in ("W1", "W2")
        for direction in RUNS.settings[run]["directions"]
        for law in ("eq5", "fitted")
    ]


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


# What the choice of the law changes in an IDA.
rule damping_choice_case:
    input:
        law=rules.beta_law.output.law,
        fidelity=FIDELITY_FILE,
    output:
        results("calibration/choice/{model}_{law}.json"),
    log:
        logs("damping_choice_{model}_{law}"),
    wildcard_constraints:
        law="eq5|fitted",
    params:
        sections=RUNS.params_of(*SECTIONS),
    script:
        str(BASE / "workflow/scripts/ida/facade_case.py")


use rule planar_ida as damping_choice_planar with:
    input:
        case=rules.damping_choice_case.output[0],
        motion=of_run(rules.floor_motions.output[0], record=CHOICE_RECORD),
    output:
        scan=results("calibration/choice/scan_{model}_{direction}_{law}.csv"),
        plan=results("calibration/choice/plan_{model}_{direction}_{law}.json"),
    benchmark:
        benchmarks("damping_choice_planar_{model}_{direction}_{law}")
    params:
        record=lambda w: CHOICE_RECORD(w.run),


use rule ida as damping_choice_ida with:
    input:
        case=rules.damping_choice_case.output[0],
        motion=of_run(rules.floor_motions.output[0], record=CHOICE_RECORD),
        plan=rules.damping_choice_planar.output.plan,
        yade=rules.yade_check.output[0],
        modules=command_code("ida"),
    output:
        curve=results("calibration/choice/{model}_{direction}_{law}.csv"),
    log:
        logs("damping_choice_{model}_{direction}_{law}"),
    benchmark:
        benchmarks("damping_choice_{model}_{direction}_{law}")
    wildcard_constraints:
        law="eq5|fitted",
    params:
        record=lambda w: CHOICE_RECORD(w.run),
        ensemble="",
        journal=results("cache/choice/{model}_{direction}_{law}.jsonl"),


rule damping_choice:
    input:
        cases=of_run(rules.damping_choice_case.output[0], cases=choices),
        ida=of_run(rules.damping_choice_ida.output[0], cases=choices),
        scans=of_run(rules.damping_choice_planar.output.scan, cases=choices),
        facts=of_run(rules.own_record.output.facts, record=CHOICE_RECORD),
    output:
        **figure("damping_choice", "Calibration of the damping", "IDA under two laws of β"),
        table=results("tables/damping_choice.csv"),
    params:
        spread=value_of("ensemble.amplitude_spread"),
    script:
        "scripts/calibrate_choice.py"
