# What the one-way coupled return walls are worth, compared with every other assumption: models side by side, a map over
# buildings, a tornado chart. Ask for `assumptions`; workflow/studies/assumptions/scenario.yaml has the runs.
ASSUMPTIONS = RUNS.key("assumptions")


def tornado_records(run):
    """Records of the tornado chart; all where none are named."""
    named = ASSUMPTIONS(run)["tornado_records"]
    return RUNS.records[run] if named is None else RUNS.named("assumptions.tornado_records")(run)


def without_scan(run):
    """Curves that no dense scan stands for."""
    return [c for c in RUNS.by_yade(run) if not RUNS.scanned(run, c.model)]


def tornado_models(run):
    """Models with a tornado chart."""
    return ASSUMPTIONS(run)["tornado_models"] if tornado_records(run) else []


rule table_assumptions:
    input:
        scans=of_run(rules.planar_ida.output.scan, cases=RUNS.scans),
        bricks=of_run(rules.ida.output[0], cases=without_scan),
        others=lambda w: list(map(RUNS.find_file, ASSUMPTIONS(w.run)["other_curves"])),
        facts=of_run(rules.record.output.facts),
    output:
        table=results("tables/assumptions.csv"),
        ratios=results("tables/assumptions_ratios.csv"),
        losses=results("tables/assumptions_losses.csv"),
    params:
        spread=value_of("ensemble.amplitude_spread"),
        reference=value_of("assumptions.reference"),
        hazard_slope=value_of("risk.hazard_slope"),
    script:
        "scripts/table_assumptions.py"


rule assumptions_map:
    input:
        case=of_run(rules.facade_case.output[0], model="W2"),
        record=rules.own_record.output.record,
    output:
        results("assumptions/map/{record}.csv"),
    benchmark:
        benchmarks("assumptions_map_{record}")
    params:
        assumptions=values_of(
            "assumptions", "mass_ratios", "periods_s", "damping_ratios", "level_ratio"
        ),
        hazard_slope=value_of("risk.hazard_slope"),
        directions=value_of("directions"),
    script:
        "scripts/assumptions_map.py"


table_of(
    "assumptions",
    "table_assumptions_map",
    tables=of_run(rules.assumptions_map.output[0]),
    digits="%.4f",
    error_by_building="assumptions_map",
)
figure_by(
    "studies/assumptions/scripts/figure_assumptions_map",
    "assumptions_map",
    "Assumptions",
    "error of one-way coupled walls, by building",
    table=rules.table_assumptions_map.output[0],
    facts=of_run(rules.record.output.facts),
    params=dict(
        smdof=value_of("smdof"),
        records=lambda w: len(RUNS.records[w.run]),
        directions=lambda w: len(RUNS.cfg(w)["directions"]),
    ),
)


def stage_of_building(wildcards):
    """What a study that models the building knows of it; nothing where there is none."""
    return OF_BUILDING["stage"](wildcards) if "stage" in OF_BUILDING else []


rule assumptions_varied:
    input:
        case=rules.facade_case.output[0],
        stage=stage_of_building,
        record=rules.own_record.output.record,
        law=LAW_FILE,
    output:
        results("assumptions/{model}/{record}.csv"),
    benchmark:
        benchmarks("assumptions_varied_{model}_{record}")
    params:
        directions=value_of("directions"),
        hazard_slope=value_of("risk.hazard_slope"),
        surrogates_table=lambda w: RUNS.find_file(ASSUMPTIONS(w.run)["surrogates_table"]),
        seed=value_of("seed"),
    script:
        "scripts/assumptions_varied.py"


table_of(
    "assumptions",
    "table_assumptions_tornado",
    tables=of_run(rules.assumptions_varied.output[0], record=tornado_records),
    digits="%.4f",
    tornado="assumptions_tornado_{model}",
)
figure_by(
    "studies/assumptions/scripts/figure_assumptions_tornado",
    "assumptions_tornado_{model}",
    "Assumptions",
    "what each assumption of {model} is worth",
    about="assumptions_tornado",
    table=rules.table_assumptions_tornado.output[0],
    facts=of_run(rules.record.output.facts),
    params=dict(facade=RUNS.params_of("facade")),
)


rule assumptions:
    """
    What walls that nothing can push, and every other assumption, change.
    Costs: 20 min; by records.
    """
    input:
        every_run(
            rules.table_assumptions.output.table,
            rules.table_assumptions.output.ratios,
            rules.table_assumptions.output.losses,
            where(
                RUNS.key("assumptions.mass_ratios"),
                rules.table_assumptions_map.output,
                rules.figure_assumptions_map.output.png,
            ),
            of_run(
                rules.table_assumptions_tornado.output,
                rules.figure_assumptions_tornado.output.png,
                model=tornado_models,
            ),
        ),
