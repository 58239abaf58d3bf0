# What a first shock leaves for the second: ask for `sequence`.


def first_shock(wildcards):
    """Name of the record that comes first; one that is not in the table ends the workflow."""
    name = RUNS.cfg(wildcards)["sequence"]["first"] or wildcards.record
    return RUNS.needed(wildcards.run, "sequence.first", [name])[0]


def searched(run):
    """Models of a run whose curves the planar solver can search."""
    return [m for m in RUNS.settings[run]["models"] if MODELS[m].scanned]


rule sequence_collapse:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        first=lambda w: of_run(rules.floor_motions.output[0])(Of(run=w.run, record=first_shock(w))),
    output:
        table=results("sequence/{model}/{record}_{direction}.csv"),
    log:
        logs("sequence_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("sequence_{model}_{record}_{direction}")
    params:
        study="sequence",
        given=lambda w: {"settings": RUNS.cfg(w)["sequence"]},
        first=first_shock,
    script:
        "../../scripts/studies/collapse.py"


table_of(
    "sequence",
    "sequence_table",
    tables=of_run(rules.sequence_collapse.output.table, model=searched),
    table="sequence",
    summary="sequence_summary",
)


def facts_of_both(wildcards):
    """Sources of the run's records, and of the one that comes first."""
    first = RUNS.cfg(wildcards)["sequence"]["first"]
    names = [*RUNS.records[wildcards.run], *([first] if first else [])]
    return of_run(rules.record.output.facts, record=list(dict.fromkeys(names)))(wildcards)


figure_of(
    "sequence",
    "sequence",
    "Records",
    "what a first shock leaves",
    caption="PGA at which half of the realisations first collapse, after a first shock over that"
    " of the façade as it was, against the first shock's PGA. One line a curve; curves that the"
    " first shock alone overturns are counted below.",
    facts=facts_of_both,
    table=rules.sequence_table.output.table,
)


rule sequence:
    """
    What a first shock leaves for the second.
    Costs: some minutes a curve; W3 the longest.
    """
    input:
        every_run(rules.sequence_table.output, rules.figure_sequence.output.png),
