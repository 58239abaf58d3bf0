# What a building that yields changes: ask for `yielding`.


rule yielding_collapse:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
    output:
        table=results("yielding/{model}/{record}_{direction}.csv"),
    log:
        logs("yielding_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("yielding_{model}_{record}_{direction}")
    params:
        study="yielding",
        given=lambda w: {
            "settings": RUNS.cfg(w)["yielding"],
            "station": RUNS.station(w),
        },
    script:
        "../../scripts/studies/collapse.py"


def yielding_models(run):
    """The run's models of one block that the planar solver has; W1 is what is lost from."""
    models = [m for m in RUNS.compiled(run) if not MODELS[m].bonded]
    if "W1" not in models or not any(MODELS[m].chain for m in models):
        stop(f"yielding: models = {models}: expected W1, and W2 or W2m")
    return models


table_of(
    "yielding",
    "yielding_table",
    tables=of_run(rules.yielding_collapse.output.table, model=yielding_models),
    table="yielding",
    summary="yielding_summary",
)
figure_of(
    "yielding",
    "yielding",
    "Yielding building",
    "the study's loss against the building's strength",
    caption="Loss of equivalent PGA from W1, whose walls move with the ground, to walls that move with"
    " a building that yields, against its strength V/W; bars and band: 90 % intervals by station."
    " Last: share of curves in which a storey of the building reaches its drift before the façade"
    " falls. Single histories at the same amplitudes.",
    summary=rules.yielding_table.output.summary,
)


rule yielding:
    """
    The study's loss against the strength of a building that yields.
    Costs: some 40 s of processor time a component and direction, of 33 curves.
    """
    input:
        every_run(rules.yielding_table.output, rules.figure_yielding.output.png),
