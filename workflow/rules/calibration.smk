# Calibration of β: free-rocking study, its law, both validations, an own wall.
import yaml


def study(run):
    return RUNS[run]["calibration"]


def study_groups(run):
    count = len(study(run)["thickness_m"]) * len(study(run)["e_mpa"])
    return [*(f"batch{i}" for i in range(1, count + 1)), "sensitivity", "free_rocking_wall"]


def beside(path):
    """A file of the configuration: as given, or beside the Snakefile if it is not found there."""
    near = BASE / path
    return str(near if not Path(path).exists() and near.exists() else path)


def group_files(pattern, groups=None):
    return lambda w: [
        pattern.format(run=w.run, group=group) for group in groups or study_groups(w.run)
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
        modules=module("workflow/rocking/calibration_study.py", "yade_scripts/stiffness.py"),
        wall=lambda w: (
            beside(study(w.run)["free_rocking_wall"]) if w.group == "free_rocking_wall" else []
        ),
    output:
        CASES,
    params:
        # an own wall is that of the configuration; the study brings its own walls
        config=lambda w: configuration.relevant(
            cfg(w),
            "calibration",
            *(("facade", "return_wall", "smdof", "numerics") if w.group == "own_wall" else ()),
        ),
    wildcard_constraints:
        group=r"batch\d+|sensitivity|free_rocking_wall|own_wall",
    log:
        "results/{run}/logs/calibration_cases_{group}.log",
    script:
        "../scripts/calibrate_cases.py"


rule free_rocking:
    input:
        cases=CASES,
        yade="results/{run}/yade.txt",
        modules=yade_modules() + module("yade_scripts/run_free_rocking.py"),
    output:
        HISTORIES,
    params:
        python=YADE_PYTHON,
        entry=str(BASE / "yade_scripts" / "run_free_rocking.py"),
    log:
        "results/{run}/logs/free_rocking_{group}.log",
    benchmark:
        "results/{run}/benchmarks/free_rocking_{group}.tsv"
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
            labels={"table": "rebounds and e_exp"},
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
            labels={"table": "best-fitting β"},
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
            labels={"table": "laws of β"},
        ),
    log:
        "results/{run}/logs/beta_law.log",
    script:
        "../scripts/calibrate_law.py"
