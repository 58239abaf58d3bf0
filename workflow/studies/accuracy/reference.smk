# The independent planar solver scans curves by itself; what of its answer the reported ones hold.


def describable(wildcards):
    """Dense scans by the independent planar solver, of the models that it can describe."""
    run = wildcards.run
    RUNS.needs_dry(run)
    models = [model for model in RUNS.settings[run]["models"] if model in REFERENCE_MODELS]
    return of_run(rules.reference_scan.output[0], model=models)(wildcards)


rule reference_scan:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        scan=rules.planar_ida.output.scan,
    output:
        results("reference/{model}/{record}_{direction}.csv"),
    benchmark:
        benchmarks("reference_scan_{model}_{record}_{direction}")
    params:
        record=lambda w: w.record,
        accuracy=values_of(
            "accuracy", "reference_nodes", "reference_tolerance", "reference_scan_step"
        ),
    script:
        "scripts/reference_scan.py"


rule reference_bands:
    input:
        scans=describable,
        collapse=rules.ida_collapse.output.collapse,
    output:
        scan=results("tables/reference_scan.csv"),
        bands=shown_table(
            "reference_bands",
            "Accuracy and stability",
            "reported bands and the reference solver's",
            about="reference_solver",
        ),
    params:
        spread=value_of("ensemble.amplitude_spread"),
    script:
        "scripts/table_reference.py"


figure_by(
    "studies/accuracy/scripts/figure_reference",
    "reference_solver",
    "Accuracy and stability",
    "collapse probability by both planar solvers",
    scan=rules.reference_bands.output.scan,
    bands=rules.reference_bands.output.bands,
    probability=rules.ida_collapse.output.probability,
    facts=of_run(rules.record.output.facts),
    params=dict(spread=value_of("ensemble.amplitude_spread")),
)


rule reference_solver:
    """
    Reported collapse compared with dense scans of an independent solver.
    Costs: some 20 min for 16 curves.
    Page: docs/accuracy.md
    """
    input:
        every_run(rules.reference_bands.output, rules.figure_reference.output.png),
