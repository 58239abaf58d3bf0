# Accuracy and stability: `snakemake accuracy`.
include: "energy.smk"


rule accuracy:
    input:
        with_pages(STUDY.per_run(ACCURACY.results)),


rule stability:
    input:
        scene="results/{run}/scenes/W2.json",
        yade="results/{run}/yade.txt",
        modules=study_code("stability"),
    output:
        trials="results/{run}/tables/stability.csv",
        limits="results/{run}/tables/stability_limits.csv",
    log:
        "results/{run}/logs/stability.log",
    params:
        yade=YADE,
    shell:
        "{params.yade} stability --scene {input.scene:q} --output {output.trials:q}"
        " --limits {output.limits:q} 2> {log:q}"


rule figure_stability:
    input:
        limits="results/{run}/tables/stability_limits.csv",
        modules=code("accuracy/figure_stability"),
    output:
        **figure("stability", "Accuracy and stability", "critical step"),
    log:
        "results/{run}/logs/figure_stability.log",
    script:
        "../scripts/accuracy/figure_stability.py"


# The compiled planar solver finds intensities, tells what repeats, and gives the reference.
rule accuracy_plan:
    input:
        scenes=ACCURACY.scenes,
        motions=ACCURACY.all_motions,
        modules=code("accuracy/accuracy_plan"),
    output:
        plan="results/{run}/accuracy/plan.json",
        histories="results/{run}/accuracy/histories.csv",
    log:
        "results/{run}/logs/accuracy_plan.log",
    benchmark:
        "results/{run}/benchmarks/accuracy_plan.tsv"
    params:
        accuracy=lambda w: STUDY.cfg(w)["accuracy"],
        ensemble=lambda w: STUDY.cfg(w)["ensemble"],
        max_pga_g=lambda w: STUDY.cfg(w)["ida"]["max_pga_g"],
        records=lambda w: STUDY.records[w.run],
    script:
        "../scripts/accuracy/accuracy_plan.py"


rule accuracy_screening:
    input:
        plan="results/{run}/accuracy/plan.json",
        modules=code("accuracy/accuracy_screening"),
    output:
        "results/{run}/accuracy/screening.csv",
    log:
        "results/{run}/logs/accuracy_screening.log",
    params:
        accuracy=lambda w: STUDY.cfg(w)["accuracy"],
    script:
        "../scripts/accuracy/accuracy_screening.py"


rule accuracy_runs:
    input:
        plan="results/{run}/accuracy/plan.json",
        yade="results/{run}/yade.txt",
        modules=study_code("accuracy"),
    output:
        "results/{run}/accuracy/runs.csv",
    log:
        "results/{run}/logs/accuracy_runs.log",
    benchmark:
        "results/{run}/benchmarks/accuracy_runs.tsv"
    params:
        yade=YADE,
    shell:
        "{params.yade} accuracy --plan {input.plan:q} --output {output:q}" " 2> {log:q}"


rule accuracy_reference:
    input:
        plan="results/{run}/accuracy/plan.json",
        modules=code("accuracy/accuracy_reference"),
    output:
        "results/{run}/accuracy/judge.csv",
    log:
        "results/{run}/logs/accuracy_reference.log",
    benchmark:
        "results/{run}/benchmarks/accuracy_reference.tsv"
    threads: 2
    params:
        accuracy=lambda w: STUDY.cfg(w)["accuracy"],
    script:
        "../scripts/accuracy/accuracy_reference.py"


# Optional: needs requirements-engines.in.
rule accuracy_engine:
    input:
        plan="results/{run}/accuracy/plan.json",
        modules=code("accuracy/engine_{engine}"),
    output:
        "results/{run}/accuracy/engine_{engine}.csv",
    log:
        "results/{run}/logs/accuracy_engine_{engine}.log",
    wildcard_constraints:
        engine="drake|mujoco",
    script:
        "../scripts/accuracy/engine_{wildcards.engine}.py"


rule speed_accuracy:
    input:
        runs=ACCURACY.runs,
        judge="results/{run}/accuracy/judge.csv",
        plan="results/{run}/accuracy/plan.json",
        histories="results/{run}/accuracy/histories.csv",
        modules=code("accuracy/table_speed_accuracy"),
    output:
        table=shown(
            "results/{run}/tables/speed_accuracy.csv",
            "speed_accuracy",
            "Accuracy and stability",
            "speed against accuracy (CSV)",
        ),
        summary=shown(
            "results/{run}/tables/accuracy_summary.csv",
            "speed_accuracy",
            "Accuracy and stability",
            "spread of errors by method (CSV)",
        ),
        fidelity="results/{run}/accuracy/fidelity.yaml",
    log:
        "results/{run}/logs/speed_accuracy.log",
    params:
        accuracy=lambda w: STUDY.cfg(w)["accuracy"],
    script:
        "../scripts/accuracy/table_speed_accuracy.py"


rule figure_speed_accuracy:
    input:
        table="results/{run}/tables/speed_accuracy.csv",
        facts=STUDY.record_facts,
        modules=code("accuracy/figure_speed_accuracy"),
    output:
        **figure("speed_accuracy", "Accuracy and stability", "speed against accuracy"),
    log:
        "results/{run}/logs/figure_speed_accuracy.log",
    script:
        "../scripts/accuracy/figure_speed_accuracy.py"


rule ensemble_members:
    input:
        ensembles=ACCURACY.ensembles,
        scenes=ACCURACY.scenes,
        motions=ACCURACY.motions,
        modules=code("accuracy/table_ensemble_members"),
    output:
        "results/{run}/tables/ensemble_members.csv",
    log:
        "results/{run}/logs/ensemble_members.log",
    params:
        records=ACCURACY.records,
    script:
        "../scripts/accuracy/table_ensemble_members.py"


rule figure_chaos:
    input:
        ensembles=ACCURACY.ensembles,
        scans=ACCURACY.scans,
        facts=ACCURACY.facts,
        modules=code("accuracy/figure_chaos"),
    output:
        **figure("chaos", "Accuracy and stability", "perturbed ensembles"),
    log:
        "results/{run}/logs/figure_chaos.log",
    params:
        percentiles=lambda w: STUDY.cfg(w)["ensemble"]["percentiles"],
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/accuracy/figure_chaos.py"
