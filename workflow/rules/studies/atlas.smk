# One formula for any façade: a design of façades under the run's records. Ask for `atlas`.


wildcard_constraints:
    base="[a-z]+",
    piece=r"\d+",


def atlas_cases(run):
    """Base and number of every piece of a run's design, with each of its records."""
    from rocking.studies.atlas import parts  # slow to load

    found = parts(RUNS.settings[run]["atlas"])
    return [
        {"record": record, "base": base, "piece": piece}
        for base, piece in found
        for record in RUNS.records[run]
    ]


rule atlas_collapse:
    input:
        record=rules.own_record.output.record,
        scenes=of_run(rules.scene.output[0], model=RUNS.planar),
        law=LAW_FILE,
        modules=code("studies/collapse", study="atlas"),
    output:
        table=results("atlas/{base}{piece}_{record}.csv"),
    log:
        logs("atlas_{base}{piece}_{record}"),
    benchmark:
        benchmarks("atlas_{base}{piece}_{record}")
    params:
        study="atlas",
        given=lambda w: {
            "settings": values_of("atlas", "seed", "max_pga_g", "others", "ranges")(w),
            "base": w.base,
            "piece": int(w.piece),
        },
        directions=value_of("directions"),
    script:
        "../../scripts/studies/collapse.py"


rule atlas_table:
    input:
        tables=of_run(rules.atlas_collapse.output.table, cases=atlas_cases),
        modules=code("studies/table", study="atlas"),
    output:
        table=results("tables/atlas.csv"),
    log:
        logs("atlas_table"),
    params:
        study="atlas",
    script:
        "../../scripts/studies/table.py"


rule atlas:
    """
    One formula for any façade: collapse of a design of façades, and what is fitted to it.
    Costs: 25 min of processor for 32 façades and 18 motions in both directions.
    """
    input:
        every_run(rules.atlas_table.output),
