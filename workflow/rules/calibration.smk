# Calibration of β: free-rocking study, its law, both validations, an own wall.
import yaml


def study(run):
    return RUNS[run]["calibration"]


def study_groups(run):
    count = len(study(run)["thickness_m"]) * len(study(run)["e_mpa"])
    return [
        *(f"batch{i}" for i in range(1, count + 1)),
        "sensitivity",
        "free_rocking_wall",
    ]


def beside(path):
    """A file of the configuration: as given, or beside the Snakefile if it is not found there."""
    near = BASE / path
    return str(near if not Path(path).exists() and near.exists() else path)


def group_files(pattern, groups=None):
    return lambda w: [
        pattern.format(run=w.run, group=group)
        for group in groups or study_groups(w.run)
    ]


CASES = "results/{run}/calibration/cases_{group}.json"
HISTORIES = "results/{run}/calibration/histories_{group}.npz"
STUDY_MODULES = module(
    "workflow/rocking/restitution.py",
    "workflow/rocking/calibration.py",
    "workflow/rocking/calibration_study.py",
    "workflow/rocking/closed_forms.py",
)


rule calibration_cases:
    input:
        modules=module(
            "workflow/rocking/calibration_study.py", "yade_scripts/stiffness.py"
        ),
        wall=lambda w: (
            beside(study(w.run)["free_rocking_wall"])
            if w.group == "free_rocking_wall"
            else []
        ),
    output:
        CASES,
    log:
        "results/{run}/logs/calibration_cases_{group}.log",
    wildcard_constraints:
        group=r"batch\d+|sensitivity|free_rocking_wall|own_wall",
    params:
        # an own wall is that of the configuration; the study brings its own walls
        config=lambda w: configuration.relevant(
            cfg(w),
            "calibration",
            *(
                ("facade", "return_wall", "smdof", "numerics")
                if w.group == "own_wall"
                else ()
            ),
        ),
    script:
        "../scripts/calibrate_cases.py"


rule free_rocking:
    input:
        cases=CASES,
        yade=ancient("results/{run}/yade.txt"),
        modules=yade_modules() + module("yade_scripts/run_free_rocking.py"),
    output:
        HISTORIES,
    log:
        "results/{run}/logs/free_rocking_{group}.log",
    benchmark:
        "results/{run}/benchmarks/free_rocking_{group}.tsv"
    params:
        python=YADE_PYTHON,
        entry=str(BASE / "yade_scripts" / "run_free_rocking.py"),
    shell:
        "{params.python:q} {params.entry:q} --cases {input.cases:q} --output {output:q}"
        " 2> >(tee {log:q} >&2)"


rule free_rocking_table:
    input:
        cases=group_files(CASES),
        histories=group_files(HISTORIES),
        modules=STUDY_MODULES,
    output:
        report(
            "results/{run}/tables/free_rocking.csv",
            caption=caption("table_free_rocking"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "rebounds and e_exp (CSV)"},
        ),
    log:
        "results/{run}/logs/free_rocking_table.log",
    script:
        "../scripts/table_free_rocking.py"


rule beta_fit:
    input:
        cases=group_files(CASES),
        histories=group_files(HISTORIES),
        modules=STUDY_MODULES,
    output:
        walls="results/{run}/tables/beta_walls.csv",
        fit=report(
            "results/{run}/tables/beta_fit.csv",
            caption=caption("table_beta_fit"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "best-fitting β (CSV)"},
        ),
    log:
        "results/{run}/logs/beta_fit.log",
    script:
        "../scripts/calibrate_fit.py"


rule beta_law:
    input:
        "results/{run}/tables/beta_walls.csv",
        modules=module("workflow/rocking/calibration.py"),
    output:
        law="results/{run}/calibration/beta_law.json",
        table=report(
            "results/{run}/tables/beta_regression.csv",
            caption=caption("table_beta_regression"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "laws of β (CSV)"},
        ),
    log:
        "results/{run}/logs/beta_law.log",
    script:
        "../scripts/calibrate_law.py"


rule fig04_calibration:
    input:
        cases="results/{run}/calibration/cases_batch1.json",
        histories="results/{run}/calibration/histories_batch1.npz",
        walls="results/{run}/tables/beta_walls.csv",
        law="results/{run}/calibration/beta_law.json",
        modules=STUDY_MODULES,
        style=STYLE,
    output:
        png=report(
            "results/{run}/figures/fig04_calibration.png",
            caption=caption("fig04"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "4: parametric study"},
        ),
        pdf="results/{run}/figures/fig04_calibration.pdf",
    log:
        "results/{run}/logs/fig04_calibration.log",
    params:
        settings=params_of("calibration"),
    script:
        "../scripts/fig04_calibration.py"


rule wall_beta:
    input:
        cases="results/{run}/calibration/cases_own_wall.json",
        histories="results/{run}/calibration/histories_own_wall.npz",
        modules=STUDY_MODULES,
        style=STYLE,
    output:
        table="results/{run}/tables/wall_beta.csv",
        png=report(
            "results/{run}/figures/wall_beta.png",
            caption=caption("wall_beta"),
            category="Calibration of the damping",
            labels={"run": "{run}", "result": "β of this façade"},
        ),
        pdf="results/{run}/figures/wall_beta.pdf",
    log:
        "results/{run}/logs/wall_beta.log",
    params:
        config=params_of("calibration", "facade", "return_wall"),
    script:
        "../scripts/calibrate_wall.py"


def calibration_results(run):
    tables = [
        "free_rocking",
        "beta_fit",
        "beta_walls",
        "beta_regression",
        "shake_table",
    ]
    figures = ["fig04_calibration", "fig05_sorrentino", "fig06_shawa", "damping_choice"]
    return [
        *(f"results/{run}/tables/{name}.csv" for name in tables),
        *(f"results/{run}/figures/{name}.png" for name in figures),
    ]


# `snakemake calibration`: the whole study.
rule calibration:
    input:
        with_pages(per_run(calibration_results)),


# `snakemake calibrate_wall --configfile my_facade.yaml`: β of the configuration's own façade.
rule calibrate_wall:
    input:
        per_run(
            lambda run: [
                f"results/{run}/tables/wall_beta.csv",
                f"results/{run}/figures/wall_beta.png",
            ]
        ),


include: "validation.smk"
