# The fitted law against both tested walls, and what the choice of the law changes in an IDA.


rule fig05_sorrentino:
    input:
        cases="results/{run}/calibration/cases_free_rocking_wall.json",
        histories="results/{run}/calibration/histories_free_rocking_wall.npz",
        law="results/{run}/calibration/beta_law.json",
        modules=code("shake_tables/fig05_sorrentino"),
    output:
        **figure(
            "fig05_sorrentino",
            "Calibration of the damping",
            "5: free rocking of the Sorrentino wall",
            about="fig05",
        ),
    log:
        "results/{run}/logs/fig05_sorrentino.log",
    params:
        settings=STUDY.params_of("calibration"),
    script:
        "../scripts/shake_tables/fig05_sorrentino.py"


rule shake_table_tests:
    input:
        wall=CALIBRATION.shake_table("wall"),
        table=CALIBRATION.shake_table("records"),
        records=CALIBRATION.shake_table_files,
        law="results/{run}/calibration/beta_law.json",
        modules=code("shake_tables/calibrate_shake_table"),
    output:
        tests="results/{run}/calibration/shake_table_tests.json",
        motions=directory("results/{run}/calibration/shake_table_motions"),
    log:
        "results/{run}/logs/shake_table_tests.log",
    params:
        settings=STUDY.params_of("calibration"),
        baseline=lambda w: STUDY.cfg(w)["baseline"],
        seed=lambda w: STUDY.cfg(w)["seed"],
    script:
        "../scripts/shake_tables/calibrate_shake_table.py"


rule shake_table:
    input:
        tests="results/{run}/calibration/shake_table_tests.json",
        motions="results/{run}/calibration/shake_table_motions",
        yade=ancient("results/{run}/yade.txt"),
        modules=study_code("shake_table"),
    output:
        "results/{run}/calibration/shake_table_histories.npz",
    log:
        "results/{run}/logs/shake_table.log",
    benchmark:
        "results/{run}/benchmarks/shake_table.tsv"
    params:
        yade=YADE,
    shell:
        "{params.yade} shake_table --tests {input.tests:q} --output {output:q}"
        " 2> {log:q}"


rule shake_table_table:
    input:
        tests="results/{run}/calibration/shake_table_tests.json",
        histories="results/{run}/calibration/shake_table_histories.npz",
        modules=code("shake_tables/table_shake_table"),
    output:
        shown(
            "results/{run}/tables/shake_table.csv",
            "table_shake_table",
            "Calibration of the damping",
            "shake-table runs (CSV)",
        ),
    log:
        "results/{run}/logs/shake_table_table.log",
    script:
        "../scripts/shake_tables/table_shake_table.py"


rule fig06_shawa:
    input:
        tests="results/{run}/calibration/shake_table_tests.json",
        histories="results/{run}/calibration/shake_table_histories.npz",
        modules=code("shake_tables/fig06_shawa"),
    output:
        **figure(
            "fig06_shawa",
            "Calibration of the damping",
            "6: shake-table tests of the Shawa wall",
            about="fig06",
        ),
    log:
        "results/{run}/logs/fig06_shawa.log",
    script:
        "../scripts/shake_tables/fig06_shawa.py"


# What the choice of the law changes in an IDA.
rule damping_choice_scene:
    input:
        law="results/{run}/calibration/beta_law.json",
        fidelity=FIDELITY_FILE,
        modules=code("ida/scene"),
    output:
        "results/{run}/calibration/choice/{model}_{law}.json",
    log:
        "results/{run}/logs/damping_choice_{model}_{law}.log",
    wildcard_constraints:
        law="eq5|fitted",
    params:
        scene=STUDY.params_of(
            "facade", "return_wall", "damping", "smdof", "numerics", "ida"
        ),
    script:
        "../scripts/ida/scene.py"


use rule screen as damping_choice_screen with:
    input:
        scene="results/{run}/calibration/choice/{model}_{law}.json",
        motion=CALIBRATION.choice_motion,
        modules=code("ida/screen"),
    output:
        scan="results/{run}/calibration/choice/scan_{model}_{direction}_{law}.csv",
        plan="results/{run}/calibration/choice/plan_{model}_{direction}_{law}.json",
    log:
        "results/{run}/logs/damping_choice_screen_{model}_{direction}_{law}.log",
    benchmark:
        "results/{run}/benchmarks/damping_choice_screen_{model}_{direction}_{law}.tsv"
    params:
        record=CALIBRATION.choice_record,


rule damping_choice_ida:
    input:
        scene="results/{run}/calibration/choice/{model}_{law}.json",
        motion=CALIBRATION.choice_motion,
        plan="results/{run}/calibration/choice/plan_{model}_{direction}_{law}.json",
        yade=ancient("results/{run}/yade.txt"),
        modules=study_code("ida"),
    output:
        "results/{run}/calibration/choice/{model}_{direction}_{law}.csv",
    log:
        "results/{run}/logs/damping_choice_{model}_{direction}_{law}.log",
    wildcard_constraints:
        law="eq5|fitted",
    params:
        yade=YADE,
        plan=plan_option,
        record=CALIBRATION.choice_record,
        journal="results/{run}/cache/choice/{model}_{direction}_{law}.jsonl",
    shell:
        "{params.yade} ida --scene {input.scene:q} --motion {input.motion:q}"
        " --record {params.record:q} --direction {wildcards.direction} {params.plan}"
        " --journal {params.journal:q} --output {output:q} 2> {log:q}"


rule damping_choice:
    input:
        scenes=CALIBRATION.choice_scenes,
        ida=CALIBRATION.choice_tables,
        facts=CALIBRATION.choice_facts,
        modules=code("shake_tables/calibrate_choice"),
    output:
        **figure(
            "damping_choice", "Calibration of the damping", "IDA under two laws of β"
        ),
        table="results/{run}/tables/damping_choice.csv",
    log:
        "results/{run}/logs/damping_choice.log",
    script:
        "../scripts/shake_tables/calibrate_choice.py"
