# The search for the study's building, and Table 2 under every reading of its text.
# Not part of the main job nor of `building`; ask for `building_search` or `wme_readings`.
rule building_search:
    input:
        lambda w: with_pages(STUDY.per_run(BUILDING.search_results)),


rule wme_readings:
    input:
        lambda w: with_pages(STUDY.per_run(BUILDING.reading_results)),


rule table_building_search:
    input:
        plan=BUILDING.search_plan,
        modules=code("building/building_search"),
    output:
        "results/{run}/tables/building_search.csv",
    log:
        "results/{run}/logs/table_building_search.log",
    benchmark:
        "results/{run}/benchmarks/table_building_search.tsv"
    params:
        building=BUILDING.keys(),
        search=BUILDING.search_keys,
    script:
        "../scripts/building/building_search.py"


rule table_building_search_best:
    input:
        plan=BUILDING.search_plan,
        search="results/{run}/tables/building_search.csv",
        plans=BUILDING.compared_plans,
        modules=code("building/building_search_verify"),
    output:
        shown(
            "results/{run}/tables/building_search_best.csv",
            "building_search",
            "Building",
            "search for the study's building (CSV)",
        ),
    log:
        "results/{run}/logs/table_building_search_best.log",
    benchmark:
        "results/{run}/benchmarks/table_building_search_best.tsv"
    params:
        building=BUILDING.keys(),
        search=BUILDING.search_keys,
    script:
        "../scripts/building/building_search_verify.py"


rule figure_building_search:
    input:
        search="results/{run}/tables/building_search.csv",
        modules=code("building/figure_building_search"),
    output:
        **figure("building_search", "Building", "search for the study's building"),
    log:
        "results/{run}/logs/figure_building_search.log",
    script:
        "../scripts/building/figure_building_search.py"


rule table_wme_readings:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        modes="results/{run}/building/SBDEM_modes.npz",
        records=BUILDING.of_wme_records("results/{run}/records/{record}.csv"),
        modules=code("building/table_wme_readings"),
    output:
        readings="results/{run}/tables/wme_readings.csv",
        lowest=shown(
            "results/{run}/tables/wme_lowest.csv",
            "wme_readings",
            "Building",
            "2: every reading of its text (CSV)",
        ),
    log:
        "results/{run}/logs/table_wme_readings.log",
    benchmark:
        "results/{run}/benchmarks/table_wme_readings.tsv"
    params:
        building=BUILDING.keys(
            "damping_ratio", "wme_longest_period_s", "wme_highest_frequency_hz"
        ),
        records=lambda w: BUILDING.records(w.run, "wme_records"),
        paper=BUILDING.is_case_study,
    script:
        "../scripts/building/table_wme_readings.py"
