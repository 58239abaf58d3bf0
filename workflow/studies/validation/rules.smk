# Walls that were tested, by both solvers, against what was measured: ask for `validation`.


def experiment_folders(run):
    """Folder of each experiment of a run, by its name."""
    paths = map(RUNS.find_file, RUNS.settings[run]["validation"]["experiments"])
    return {Path(path).name: path for path in paths}


def experiment_files(wildcards):
    """The files of an experiment, its own specimen first."""
    from studies.validation.study import files  # slow to load

    return [str(path) for path in files(experiment_folders(wildcards.run)[wildcards.experiment])]


def models_of(wildcards):
    """Experiments of a run that are models of one test, by the name of the first."""
    from studies.validation.study import files  # slow to load

    folders = experiment_folders(wildcards.run).items()
    return [n for n, path in folders if files(path)[-1].parent.name == wildcards.test]


def held_against(run):
    """What `validation` makes for one run; a folder of no experiment ends the workflow."""
    from studies.validation.study import files, read  # slow to load

    folder = RUNS.settings[run]["validation"]["motions_folder"]
    if folder and not Path(folder).is_dir():
        stop(f"validation.motions_folder = {folder}: expected a folder of measured table motions")
    made, tests = [], []
    for name, folder in experiment_folders(run).items():
        try:
            kind = read(folder).specimen["kind"]
        except (configuration.ConfigError, OSError) as error:
            stop(f"validation.experiments: {error}")
        made.append(f"{RESULTS}/{run}/validation/{name}/{kind}.csv")
        if kind == "shake_table":
            made.append(f"{RESULTS}/{run}/figures/validation_shake_table_{name}.png")
            tests.append(files(folder)[-1].parent.name)
    several = sorted({test for test in tests if tests.count(test) > 1})
    return made + [f"{RESULTS}/{run}/figures/validation_models_{test}.png" for test in several]


wildcard_constraints:
    experiment="[A-Za-z0-9_.-]+",
    test="[A-Za-z0-9_.-]+",


rule validation_cases:
    input:
        files=experiment_files,
    output:
        cases=results("validation/{experiment}/cases.json"),
        tests=results("validation/{experiment}/tests.json"),
        motions=directory(results("validation/{experiment}/motions")),
    params:
        table=RUNS.find_file("config/suites/recorded_suite.tsv"),
        settings=RUNS.params_of("validation"),
    script:
        "scripts/validation_cases.py"


rule validation_planar:
    input:
        cases=rules.validation_cases.output.cases,
        motions=rules.validation_cases.output.motions,
    output:
        results("validation/{experiment}/planar.csv"),
    benchmark:
        benchmarks("validation_planar_{experiment}")
    params:
        settings=RUNS.params_of("validation", "seed"),
    script:
        "scripts/validation_planar.py"


walls_of(
    "validation_yade",
    cases=rules.validation_cases.output.tests,
    path=results("validation/{experiment}/histories.npz"),
    motions=rules.validation_cases.output.motions,
)


rule validation_shake_table:
    input:
        files=experiment_files,
        cases=rules.validation_cases.output.cases,
        planar=rules.validation_planar.output[0],
        histories=rules.validation_yade.output[0],
    output:
        table=results("validation/{experiment}/shake_table.csv"),
        summary=results("validation/{experiment}/summary.csv"),
    script:
        "scripts/validation_shake_table.py"


figure_by(
    "studies/validation/scripts/figure_shake_table",
    "validation_shake_table_{experiment}",
    "Held against experiments",
    "{experiment}",
    about="validation",
    files=experiment_files,
    table=rules.validation_shake_table.output.table,
    params=dict(settings=RUNS.params_of("validation")),
)


# models of the same test beside each other
figure_by(
    "studies/validation/scripts/figure_models",
    "validation_models_{test}",
    "Held against experiments",
    "models of {test}",
    about="validation",
    specimens=lambda w: [
        f"{experiment_folders(w.run)[name]}/specimen.yaml" for name in models_of(w)
    ],
    tables=lambda w: [
        f"{RESULTS}/{w.run}/validation/{name}/shake_table.csv" for name in models_of(w)
    ],
)


rule validation_rocking_cases:
    input:
        files=experiment_files,
    output:
        results("validation/{experiment}/rocking_cases.json"),
    script:
        "scripts/validation_rocking_cases.py"


walls_of(
    "validation_rocking_yade",
    cases=rules.validation_rocking_cases.output[0],
    path=results("validation/{experiment}/rocking_histories.npz"),
)


rule validation_rocking:
    input:
        files=experiment_files,
        cases=rules.validation_rocking_cases.output[0],
        histories=rules.validation_rocking_yade.output[0],
    output:
        results("validation/{experiment}/free_rocking.csv"),
    script:
        "scripts/validation_rocking.py"


rule validation:
    """
    Walls that others tested, by both solvers, against what they measured.
    Costs: 14 min; by runs and members.
    Page: docs/evidence.md
    """
    input:
        lambda w: [path for run in RUNS.settings for path in held_against(run)],
