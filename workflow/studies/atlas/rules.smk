# One formula for any façade: a design of façades under the run's records. Ask for `atlas`.


FORMULA_FILE = str(BASE / "config" / "formula.json")


wildcard_constraints:
    base="[a-z]+",
    piece=r"\d+",


def atlas_cases(run):
    """Base and number of every piece of a run's design, with each of its records."""
    from studies.atlas.study import parts  # slow to load

    return parts(RUNS.settings[run]["atlas"], RUNS.records[run])


rule atlas_collapse:
    input:
        record=rules.own_record.output.record,
        cases=of_run(rules.facade_case.output[0], model=RUNS.compiled),
        law=LAW_FILE,
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


table_of(
    "atlas",
    "atlas_table",
    tables=of_run(rules.atlas_collapse.output.table, cases=atlas_cases),
    table="atlas",
)


rule atlas_formula:
    input:
        table=rules.atlas_table.output.table,
        records=of_run(rules.record.output.record),
        case=of_run(rules.facade_case.output[0], model="W2m"),
        law=LAW_FILE,
    output:
        formula=results("formula.json"),
        facades=results("tables/atlas_facades.csv"),
    params:
        settings=values_of("atlas", "facades", "seed", "ranges", "others"),
        base=value_of("facade.base"),
        directions=value_of("directions"),
        damping_ratio=value_of("smdof.damping_ratio"),
        stations=stations,
    script:
        "scripts/atlas_formula.py"


rule formula_page:
    input:
        formula=rules.atlas_formula.output.formula,
    output:
        results("formula.html"),
    script:
        "scripts/formula_page.py"


figure_of(
    "atlas",
    "atlas_chart",
    "Fragility",
    "one formula for any façade",
    caption="Median PGA of half collapse by the formula, against the façade's height: one line a"
    " slenderness and first period, the band of one standard deviation over ground motions"
    " about one of them.",
    formula=rules.atlas_formula.output.formula,
)


rule class_fragility:
    input:
        law=FORMULA_FILE,
    output:
        table=results("tables/class_fragility.csv"),
        facades=results("class/facades.csv"),
        pga_g=results("class/fragility_pga_g.xml"),
        pgv_cm_s=results("class/fragility_pgv_cm_s.xml"),
    params:
        settings=value_of("facade_class"),
        facade=values_of("facade", "base", "courses", "courses_growth"),
        models=lambda w: [m for m in RUNS.compiled(w.run) if m in ("W1", "W2", "W2m")],
    script:
        "scripts/class_fragility.py"


rule facade_class:
    """
    Fragility of a class of façades by the formula, scatter by façade and by motion apart; NRML too.
    Costs: seconds; nothing is shaken.
    Page: workflow/studies/atlas/page.md
    """
    input:
        every_run(rules.class_fragility.output.table),


rule atlas:
    """
    One formula for any façade: collapse of a design of façades, and what is fitted to it.
    Costs: half an hour of one core for 32 façades and sixteen motions in both directions; by façades, motions and their length.
    """
    input:
        every_run(
            rules.atlas_table.output,
            rules.atlas_formula.output,
            rules.formula_page.output,
            rules.figure_atlas_chart.output.png,
        ),
