# Which files the calibration needs and makes; functions only.


def study(run):
    """Section calibration of a run."""
    return RUNS[run]["calibration"]


def study_groups(run):
    """Parts of the free-rocking study, a job each."""
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
    """Input function: one file of every part of the study."""
    return lambda w: [
        pattern.format(run=w.run, group=group)
        for group in groups or study_groups(w.run)
    ]


CASES = "results/{run}/calibration/cases_{group}.json"
HISTORIES = "results/{run}/calibration/histories_{group}.npz"
STUDY_MODULES = module(
    "workflow/rocking/calibration/restitution.py",
    "workflow/rocking/calibration/beta.py",
    "workflow/rocking/calibration/study.py",
    "workflow/rocking/mechanics/closed_forms.py",
)


def shake_table_files(wildcards):
    """Record files of the shake-table motions; none for surrogates."""
    try:
        rows = read_table(beside(study(wildcards.run)["shake_table_records"]))
    except RecordError as error:
        stop(error)
    return [row.path for row in rows.values() if row.path]


def choices(run):
    """Model, direction and law of each IDA that compares the laws."""
    return [
        (model, direction, law)
        for model in ("W1", "W2")
        for direction in RUNS[run]["directions"]
        for law in ("eq5", "fitted")
    ]


def calibration_results(run):
    """What `snakemake calibration` makes for one run."""
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
