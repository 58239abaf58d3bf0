# Façades in three dimensions under both horizontal components, compared with the planar scene under one.
from rocking.records.table import second_component as mate


def one_block(run):
    """The run's models with dry, one-way coupled walls and one block."""
    resolved = RUNS.settings[run]
    for key in ("hinges_m", "courses", "ties", "floors"):
        if given := resolved["facade"][key]:
            stop(f"two_components: facade.{key} = {given}: expected none")
    wanted = [m for m in RUNS.compiled(run) if MODELS[m].plain == m]
    if not wanted:
        stop(f"two_components: models = {resolved['models']}: expected W1 or W2")
    return wanted


def second_component(wildcards):
    """The other record of the table with the same event and station; None without one."""
    return mate(RUNS.tables[wildcards.run], wildcards.record)


def motion_along(wildcards):
    """Floor motions of the component along the façade; ends the workflow without one."""
    second = second_component(wildcards)
    if second is None:
        stop(
            f"two_components: record {wildcards.record} in {RUNS.table_path(wildcards.run)}: expected one"
            " more record of the same event and station, such as in"
            " records_table=config/suites/recorded_suite.tsv"
        )
    return of_run(rules.floor_motions.output[0], record=second)(wildcards)


rule two_components_curves:
    input:
        cases=of_run(rules.facade_case.output[0], model=one_block),
        motion=of_run(rules.floor_motions.output[0]),
        second=motion_along,
        yade=rules.yade_check.output[0],
        command=command_code("runs"),
    output:
        table=results("two_components/{record}.csv"),
    log:
        logs("two_components_{record}"),
    benchmark:
        benchmarks("two_components_{record}")
    params:
        study="two_components",
        given=lambda w: {"settings": RUNS.cfg(w)["two_components"]},
        directions=value_of("directions"),
        second=second_component,
    script:
        "../../scripts/studies/collapse.py"


table_of(
    "two_components",
    "two_components_table",
    tables=of_run(rules.two_components_curves.output.table),
    table="two_components",
    summary="two_components_summary",
)
figure_of(
    "two_components",
    "two_components",
    "Two components",
    "both components compared with one",
    caption="The façade in three dimensions under both horizontal components, compared with the"
    " planar scene under one. Left: lowest PGA that overturns it under both over that under one"
    " (both), and over itself with a node more and a shorter step (repeated), as distributions"
    " over records and directions. Right: largest d/b under both over that under one, at half"
    " the planar collapse, against the PGA of the component along the façade.",
    table=rules.two_components_table.output.table,
)


rule two_components:
    """
    What the second horizontal component changes.
    Costs: some 50 min of processor time for 88 curves of W1 and of W2.
    """
    input:
        every_run(rules.two_components_table.output, rules.figure_two_components.output.png),
