# Accuracy and stability: `snakemake accuracy`.
include: "accuracy_targets.smk"
include: "energy.smk"


rule accuracy:
    input:
        with_pages(per_run(accuracy_results)),


rule stability:
    input:
        entry=module("yade_scripts/studies/stability.py"),
        scene="results/{run}/scenes/W2.json",
        yade="results/{run}/yade.txt",
        modules=yade_modules(),
    output:
        trials="results/{run}/tables/stability.csv",
        limits="results/{run}/tables/stability_limits.csv",
    log:
        "results/{run}/logs/stability.log",
    params:
        python=YADE_PYTHON,
    shell:
        "{params.python:q} {input.entry:q} --scene {input.scene:q} --output {output.trials:q}"
        " --limits {output.limits:q} 2> >(tee {log:q} >&2)"


rule figure_stability:
    input:
        limits="results/{run}/tables/stability_limits.csv",
        style=STYLE,
    output:
        png=report(
            "results/{run}/figures/stability.png",
            caption=caption("stability"),
            category="Accuracy and stability",
            labels={"run": "{run}", "result": "critical step"},
        ),
        pdf="results/{run}/figures/stability.pdf",
    log:
        "results/{run}/logs/figure_stability.log",
    script:
        "../scripts/figure_stability.py"


rule accuracy_plan:
    input:
        curves=accuracy_curves,
        scenes=lambda w: [
            f"results/{w.run}/scenes/{model}.json"
            for model in cfg(w)["accuracy"]["models"]
        ],
        motions=accuracy_motions,
        modules=module("workflow/rocking/accuracy/study.py"),
    output:
        "results/{run}/accuracy/plan.json",
    log:
        "results/{run}/logs/accuracy_plan.log",
    params:
        accuracy=lambda w: cfg(w)["accuracy"],
        ensemble=lambda w: cfg(w)["ensemble"],
    script:
        "../scripts/accuracy_plan.py"


rule accuracy_runs:
    input:
        entry=module("yade_scripts/studies/accuracy.py"),
        plan="results/{run}/accuracy/plan.json",
        yade="results/{run}/yade.txt",
        modules=yade_modules(),
    output:
        "results/{run}/accuracy/runs.csv",
    log:
        "results/{run}/logs/accuracy_runs.log",
    benchmark:
        "results/{run}/benchmarks/accuracy_runs.tsv"
    params:
        python=YADE_PYTHON,
    shell:
        "{params.python:q} {input.entry:q} --plan {input.plan:q} --output {output:q}"
        " 2> >(tee {log:q} >&2)"


rule accuracy_reference:
    input:
        plan="results/{run}/accuracy/plan.json",
        modules=module(
            *(
                f"workflow/rocking/planar/{name}.py"
                for name in ("adaptive", "batch", "contact", "motion", "wall")
            ),
            "workflow/rocking/curves/reference.py",
            "yade_scripts/model/motion.py",
        ),
    output:
        "results/{run}/accuracy/reference.csv",
    log:
        "results/{run}/logs/accuracy_reference.log",
    benchmark:
        "results/{run}/benchmarks/accuracy_reference.tsv"
    threads: 2
    params:
        accuracy=lambda w: cfg(w)["accuracy"],
    script:
        "../scripts/accuracy_reference.py"


# Optional: needs requirements-engines.in.
rule accuracy_engine:
    input:
        plan="results/{run}/accuracy/plan.json",
        modules=module(
            "workflow/rocking/accuracy/outside.py",
            "yade_scripts/model/facade.py",
            "yade_scripts/model/motion.py",
            "yade_scripts/model/stiffness.py",
        ),
    output:
        "results/{run}/accuracy/engine_{engine}.csv",
    log:
        "results/{run}/logs/accuracy_engine_{engine}.log",
    wildcard_constraints:
        engine="drake|mujoco",
    script:
        "../scripts/engine_{wildcards.engine}.py"


rule speed_accuracy:
    input:
        runs=lambda w: [
            f"results/{w.run}/accuracy/runs.csv",
            *(
                f"results/{w.run}/accuracy/engine_{engine}.csv"
                for engine in cfg(w)["accuracy"]["engines"]
            ),
        ],
        reference="results/{run}/accuracy/reference.csv",
        modules=module("workflow/rocking/accuracy/study.py"),
    output:
        table=report(
            "results/{run}/tables/speed_accuracy.csv",
            caption=caption("speed_accuracy"),
            category="Accuracy and stability",
            labels={"run": "{run}", "result": "speed against accuracy (CSV)"},
        ),
        fidelity="results/{run}/accuracy/fidelity.yaml",
    log:
        "results/{run}/logs/speed_accuracy.log",
    params:
        ensemble=lambda w: cfg(w)["ensemble"],
        fewest_nodes=lambda w: cfg(w)["accuracy"]["fewest_nodes"],
    script:
        "../scripts/table_speed_accuracy.py"


rule figure_speed_accuracy:
    input:
        table="results/{run}/tables/speed_accuracy.csv",
        style=STYLE,
        modules=module("workflow/rocking/accuracy/study.py"),
    output:
        png=report(
            "results/{run}/figures/speed_accuracy.png",
            caption=caption("speed_accuracy"),
            category="Accuracy and stability",
            labels={"run": "{run}", "result": "speed against accuracy"},
        ),
        pdf="results/{run}/figures/speed_accuracy.pdf",
    log:
        "results/{run}/logs/figure_speed_accuracy.log",
    script:
        "../scripts/figure_speed_accuracy.py"


rule ensemble_members:
    input:
        ensembles=lambda w: accuracy_curves(w, "_ensemble"),
        scenes=lambda w: [
            f"results/{w.run}/scenes/{model}.json"
            for model in cfg(w)["accuracy"]["models"]
        ],
        motions=accuracy_motions,
        modules=module(
            "workflow/rocking/curves/ensemble.py",
            "workflow/rocking/curves/reference.py",
            "yade_scripts/model/motion.py",
        ),
    output:
        "results/{run}/tables/ensemble_members.csv",
    log:
        "results/{run}/logs/ensemble_members.log",
    params:
        records=accuracy_records,
    script:
        "../scripts/table_ensemble_members.py"


rule figure_chaos:
    input:
        ensembles=lambda w: accuracy_curves(w, "_ensemble"),
        style=STYLE,
        modules=module("workflow/rocking/curves/ensemble.py"),
    output:
        png=report(
            "results/{run}/figures/chaos.png",
            caption=caption("chaos"),
            category="Accuracy and stability",
            labels={"run": "{run}", "result": "perturbed ensembles"},
        ),
        pdf="results/{run}/figures/chaos.pdf",
    log:
        "results/{run}/logs/figure_chaos.log",
    params:
        percentiles=lambda w: cfg(w)["ensemble"]["percentiles"],
    script:
        "../scripts/figure_chaos.py"
