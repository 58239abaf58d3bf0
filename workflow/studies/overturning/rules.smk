# Fell or stood: predictions of shake-table tests against their outcomes; ask for `overturning`.


def overturning_tests(wildcards):
    """The table of tests, where one is stated; one that is missing ends the workflow."""
    given = RUNS.cfg(wildcards)["overturning"]["tests"]
    if given and not Path(given).is_file():
        stop(f"overturning.tests = {given}: expected a table of tests with outcomes")
    return [given] if given else []


def overturning_files(wildcards):
    """What a prediction's digest is of, and the digest."""
    folder = Path(RUNS.find_file(RUNS.cfg(wildcards)["overturning"]["prediction"]))
    names = ("digest.txt", "geometry.yaml", "geometry.csv", "fitted.yaml", "fitted.csv")
    if missing := [name for name in names if not (folder / name).is_file()]:
        stop(f"overturning.prediction = {folder}: expected {missing[0]} of a prediction")
    return [str(folder / name) for name in names]


rule overturning_calibration:
    input:
        files=overturning_files,
        tests=overturning_tests,
    output:
        results("tables/overturning_calibration.csv"),
    params:
        folder=lambda w, input: str(Path(input.files[0]).parent),
    script:
        "scripts/overturning_calibration.py"


figure_of(
    "overturning",
    "overturning_calibration",
    "Held against experiments",
    "fell or stood",
    caption="Of tests to which a model gave a probability of a fall, in five bins: the share that"
    " fell (dots; hollow where it lies outside) and the range in which it should lie, 90 %. Both"
    " blocks together. Columns of ``tables/overturning_calibration.csv``: docs/evidence.md.",
    facts=lambda w: [],
    table=rules.overturning_calibration.output[0],
)


rule overturning:
    """
    Falls of two blocks on a shake table, predicted, against what happened.
    Costs: seconds.
    Page: docs/evidence.md
    """
    input:
        every_run(
            rules.overturning_calibration.output, rules.figure_overturning_calibration.output.png
        ),
