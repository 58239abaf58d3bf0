# The building as an assembly of bricks: modes, time histories, equal chains, explicit check.
# Not part of the main job; ask for `building`, or for any file below.


include: "modal.smk"


CHAINS = (
    "damping_ratio",
    "wme_longest_period_s",
    "wme_highest_frequency_hz",
    "wme_gain",
)


wildcard_constraints:
    coarsening=r"[0-9.]+",


def is_case_study(run):
    """Whether the study's own figures belong with the results."""
    return Path(RUNS.settings[run]["building"]["plan"]).stem.startswith("case_study")


rule table_building_modes:
    input:
        cbdem=of_run(rules.building_modal.output[0], building="CBDEM"),
        sbdem=of_run(rules.building_modal.output[0], building="SBDEM"),
    output:
        shown_table("building_modes", "Building", "periods and effective masses"),
    params:
        paper=lambda w: is_case_study(w.run),
    script:
        "scripts/table_building_modes.py"


rule building_history:
    input:
        plan=plan_file,
        fit=rules.building_fit.output[0],
        modes=rules.building_modal.output[0],
        record=rules.own_record.output.record,
    output:
        results("building/history_{building}_{record}.csv"),
    params:
        building=values_of("building", *BRICK_MODEL, "damping_ratio"),
    script:
        "scripts/building_history.py"


rule table_wme:
    input:
        modes=of_run(rules.building_modal.output[0], building="SBDEM"),
        histories=of_run(
            rules.building_history.output[0],
            building="SBDEM",
            record=RUNS.named("building.wme_records"),
        ),
        records=of_run(rules.own_record.output.record, record=RUNS.named("building.wme_records")),
    output:
        wme=shown_table("wme", "Building", "2: weighted mean error of chains"),
        chain=results("tables/building_chain.csv"),
        config=results("building/chain.yaml"),
    params:
        building=values_of("building", *CHAINS),
        records=lambda w: RUNS.named("building.wme_records")(w.run),
        paper=lambda w: is_case_study(w.run),
    script:
        "scripts/table_wme.py"


figure_by(
    "studies/building/scripts/fig01_building",
    "fig01_building",
    "Building",
    "1: brick models",
    plan=plan_file,
    params=dict(building=values_of("building", *BRICK_MODEL)),
)


figure_by(
    "studies/building/scripts/fig02_modes",
    "fig02_modes",
    "Building",
    "2: modes",
    plan=plan_file,
    fit=rules.building_fit.output[0],
    cbdem=of_run(rules.building_modal.output[0], building="CBDEM"),
    sbdem=of_run(rules.building_modal.output[0], building="SBDEM"),
    params=dict(building=values_of("building", *BRICK_MODEL), paper=lambda w: is_case_study(w.run)),
)


rule fig03_wme:
    input:
        modes=of_run(rules.building_modal.output[0], building="SBDEM"),
        history=of_run(rules.building_history.output[0], building="SBDEM"),
        record=rules.own_record.output.record,
        facts=rules.own_record.output.facts,
    output:
        **figure(
            "fig03_{record}",
            "Building",
            "3: SBDEM and equal chains",
            about="fig03",
            record="{record}",
        ),
    log:
        logs("fig03_{record}"),
    params:
        building=values_of("building", *CHAINS),
    script:
        "scripts/fig03_wme.py"


include: "explicit.smk"


rule table_claims_building:
    input:
        modes=rules.table_building_modes.output[0],
        wme=rules.table_wme.output.wme,
        explicit=of_run(
            rules.table_building_explicit.output.table,
            record=RUNS.named("building.explicit_records"),
        ),
    output:
        shown_table("claims_building", "Building", "claims of the 3DEC study's section 2"),
    script:
        "scripts/table_claims_building.py"


rule building:
    """
    Brick models, modes, periods, errors of the chains, Figures 1, 2, 3.
    Costs: minutes; by bricks.
    Page: docs/building.md
    """
    input:
        every_run(
            rules.table_building_modes.output,
            rules.table_wme.output.wme,
            rules.table_wme.output.chain,
            rules.fig01_building.output.png,
            rules.fig02_modes.output.png,
            of_run(rules.fig03_wme.output.png, record=RUNS.named("building.wme_records")),
            of_run(
                rules.table_building_explicit.output.png,
                rules.table_building_explicit.output.table,
                record=RUNS.named("building.explicit_records"),
            ),
            where(is_case_study, rules.table_claims_building.output),
        ),


rule building_t1:
    """
    Periods and chain of a plan of your own, without the 3DEC study's comparisons.
    Costs: minutes; by bricks.
    Page: docs/building.md
    """
    input:
        every_run(rules.table_building_modes.output, rules.table_wme.output.chain),


include: "complete.smk"
