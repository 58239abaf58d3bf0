# The search for the study's building, and Table 2 under every reading of its text.
# Not part of the main job nor of `building`; ask for `building_search` or `wme_readings`.
def search_settings(wildcards):
    """Params function: the section of the search, plans apart."""
    section = RUNS.cfg(wildcards)["building_search"]
    return {k: value for k, value in section.items() if k not in ("plan", "plans")}


rule table_building_search:
    input:
        plan=plan_file("building_search.plan"),
    output:
        results("tables/building_search.csv"),
    benchmark:
        benchmarks("table_building_search")
    params:
        building=values_of("building", *BRICK_MODEL),
        search=search_settings,
    script:
        "../scripts/building/building_search.py"


rule table_building_search_best:
    input:
        plan=plan_file("building_search.plan"),
        search=rules.table_building_search.output[0],
        plans=plan_file("building_search.plans"),
    output:
        shown_table(
            "building_search_best",
            "Building",
            "search for the study's building",
            about="building_search",
        ),
    benchmark:
        benchmarks("table_building_search_best")
    params:
        building=values_of("building", *BRICK_MODEL),
        search=search_settings,
    script:
        "../scripts/building/building_search_verify.py"


figure_by(
    "building/figure_building_search",
    "building_search",
    "Building",
    "search for the study's building",
    search=rules.table_building_search.output[0],
)


rule table_wme_readings:
    input:
        plan=plan_file("building.plan"),
        fit=rules.building_fit.output[0],
        modes=of_run(rules.building_modal.output[0], building="SBDEM"),
        records=of_run(rules.own_record.output.record, record=RUNS.named("building.wme_records")),
    output:
        readings=results("tables/wme_readings.csv"),
        lowest=shown_table("wme_lowest", "Building", "2: every reading of its text"),
    benchmark:
        benchmarks("table_wme_readings")
    params:
        building=values_of(
            "building",
            *BRICK_MODEL,
            "damping_ratio",
            "wme_longest_period_s",
            "wme_highest_frequency_hz",
        ),
        records=lambda w: RUNS.named("building.wme_records")(w.run),
        paper=lambda w: is_case_study(w.run),
    script:
        "../scripts/building/table_wme_readings.py"


rule building_search:
    """
    Variants of the case study, searched for the study's periods.
    Costs: 3 min; by variants.
    Page: docs/building.md
    """
    input:
        every_run(
            rules.table_building_search.output,
            rules.table_building_search_best.output,
            rules.figure_building_search.output.png,
        ),


rule wme_readings:
    """
    Table 2 of the study under every reading of its text.
    Costs: a minute.
    """
    input:
        every_run(rules.table_wme_readings.output),
