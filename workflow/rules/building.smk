# The building as an assembly of bricks: modes, time histories, equal chains, explicit check.
# Not part of the main job; ask for `building`, or for any file below.
wildcard_constraints:
    building="CBDEM|SBDEM",
    coarsening=r"[0-9.]+",


rule building:
    input:
        lambda w: with_pages(STUDY.per_run(BUILDING.results)),


# Periods and equivalent chain (n, T1) of any plan, without the paper's comparisons.
rule building_t1:
    input:
        lambda w: with_pages(STUDY.per_run(BUILDING.periods)),


rule building_fit:
    input:
        plan=BUILDING.plan,
        modules=code("building/building_fit"),
    output:
        "results/{run}/building/fit.json",
    log:
        "results/{run}/logs/building_fit.log",
    benchmark:
        "results/{run}/benchmarks/building_fit.tsv"
    params:
        building=BUILDING.keys(),
    script:
        "../scripts/building/building_fit.py"


rule building_modal:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        modules=code("building/building_modal"),
    output:
        "results/{run}/building/{building}_modes.npz",
    log:
        "results/{run}/logs/building_modal_{building}.log",
    benchmark:
        "results/{run}/benchmarks/building_modal_{building}.tsv"
    params:
        building=BUILDING.keys("modes"),
    script:
        "../scripts/building/building_modal.py"


rule table_building_modes:
    input:
        cbdem="results/{run}/building/CBDEM_modes.npz",
        sbdem="results/{run}/building/SBDEM_modes.npz",
        modules=code("building/table_building_modes"),
    output:
        shown(
            "results/{run}/tables/building_modes.csv",
            "fig02_table",
            "Building",
            "periods and effective masses (CSV)",
        ),
    log:
        "results/{run}/logs/table_building_modes.log",
    params:
        paper=BUILDING.is_case_study,
    script:
        "../scripts/building/table_building_modes.py"


rule table_building_alternatives:
    input:
        plans=BUILDING.all_plans,
        modules=code("building/table_building_alternatives"),
    output:
        shown(
            "results/{run}/tables/building_alternatives.csv",
            "fig02_alternatives",
            "Building",
            "periods of alternative plans (CSV)",
        ),
    log:
        "results/{run}/logs/table_building_alternatives.log",
    params:
        building=BUILDING.keys(),
    script:
        "../scripts/building/table_building_alternatives.py"


rule building_cost:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        modules=code("building/building_cost"),
    output:
        "results/{run}/building/cost_{building}_{coarsening}.json",
    log:
        "results/{run}/logs/building_cost_{building}_{coarsening}.log",
    benchmark:
        "results/{run}/benchmarks/building_cost_{building}_{coarsening}.tsv"
    resources:
        mem_mb=lambda w: 6000 if float(w.coarsening) < 1.2 else 1500,
    params:
        building=BUILDING.keys(),
    script:
        "../scripts/building/building_cost.py"


rule table_building_convergence:
    input:
        cost=BUILDING.costs,
        modules=code("building/table_building_convergence"),
    output:
        shown(
            "results/{run}/tables/building_convergence.csv",
            "fig02_convergence",
            "Building",
            "convergence and cost of the modes (CSV)",
        ),
    log:
        "results/{run}/logs/table_building_convergence.log",
    script:
        "../scripts/building/table_building_convergence.py"


rule building_history:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        modes="results/{run}/building/{building}_modes.npz",
        record="results/{run}/records/{record}.csv",
        modules=code("building/building_history"),
    output:
        "results/{run}/building/history_{building}_{record}.csv",
    log:
        "results/{run}/logs/building_history_{building}_{record}.log",
    params:
        building=BUILDING.keys("damping_ratio"),
    script:
        "../scripts/building/building_history.py"


rule table_wme:
    input:
        modes="results/{run}/building/SBDEM_modes.npz",
        histories=BUILDING.of_wme_records(
            "results/{run}/building/history_SBDEM_{record}.csv"
        ),
        records=BUILDING.of_wme_records("results/{run}/records/{record}.csv"),
        modules=code("building/table_wme"),
    output:
        wme=shown(
            "results/{run}/tables/wme.csv",
            "fig03_table",
            "Building",
            "2: weighted mean error of chains (CSV)",
        ),
        chain="results/{run}/tables/building_chain.csv",
        config="results/{run}/building/chain.yaml",
    log:
        "results/{run}/logs/table_wme.log",
    params:
        building=BUILDING.wme_keys,
        records=lambda w: BUILDING.records(w.run, "wme_records"),
        paper=BUILDING.is_case_study,
    script:
        "../scripts/building/table_wme.py"


rule fig01_building:
    input:
        plan=BUILDING.plan,
        modules=code("building/fig01_building"),
    output:
        **figure("fig01_building", "Building", "1: brick models", about="fig01"),
    log:
        "results/{run}/logs/fig01_building.log",
    params:
        building=BUILDING.keys(),
    script:
        "../scripts/building/fig01_building.py"


rule fig02_modes:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        cbdem="results/{run}/building/CBDEM_modes.npz",
        sbdem="results/{run}/building/SBDEM_modes.npz",
        modules=code("building/fig02_modes"),
    output:
        **figure("fig02_modes", "Building", "2: modes", about="fig02"),
    log:
        "results/{run}/logs/fig02_modes.log",
    params:
        building=BUILDING.keys(),
        paper=BUILDING.is_case_study,
    script:
        "../scripts/building/fig02_modes.py"


rule fig03_wme:
    input:
        modes="results/{run}/building/SBDEM_modes.npz",
        history="results/{run}/building/history_SBDEM_{record}.csv",
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
        modules=code("building/fig03_wme"),
    output:
        **figure(
            "fig03_{record}",
            "Building",
            "3: SBDEM and equal chains",
            about="fig03",
            record="{record}",
        ),
    log:
        "results/{run}/logs/fig03_{record}.log",
    params:
        building=BUILDING.wme_keys,
    script:
        "../scripts/building/fig03_wme.py"


rule building_explicit_scene:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        modules=code("building/building_explicit_scene"),
    output:
        "results/{run}/building/explicit_scene_{coarsening}.json",
    log:
        "results/{run}/logs/building_explicit_scene_{coarsening}.log",
    params:
        building=BUILDING.keys(
            "damping_ratio", "explicit_step_fraction", "explicit_duration_s"
        ),
    script:
        "../scripts/building/building_explicit_scene.py"


# The drawing's building under the record, with its dead load applied at once or left out.
rule building_explicit:
    input:
        scene=BUILDING.explicit_scene,
        record="results/{run}/records/{record}.csv",
        yade="results/{run}/yade.txt",
        modules=study_code("explicit_building"),
    output:
        history="results/{run}/building/explicit_{load}_{record}.csv",
        cost="results/{run}/building/explicit_{load}_{record}.json",
    log:
        "results/{run}/logs/building_explicit_{load}_{record}.log",
    benchmark:
        "results/{run}/benchmarks/building_explicit_{load}_{record}.tsv"
    wildcard_constraints:
        load="plain|loaded",
    params:
        yade=YADE,
        gravity=lambda w: BUILDING.sudden_gravity(w.load),
    shell:
        "{params.yade} explicit_building --scene {input.scene:q} --motion {input.record:q}"
        " --gravity {params.gravity} --output {output.history:q} --cost {output.cost:q}"
        " 2> {log:q}"


rule table_building_explicit:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        scene=BUILDING.explicit_scene,
        plain="results/{run}/building/explicit_plain_{record}.csv",
        loaded="results/{run}/building/explicit_loaded_{record}.csv",
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
        modules=code("building/table_building_explicit"),
    output:
        **figure(
            "fig03_rattling_{record}",
            "Building",
            "explicit and modal, rattling",
            about="fig03_rattling",
            record="{record}",
        ),
        table="results/{run}/tables/building_explicit_{record}.csv",
    log:
        "results/{run}/logs/table_building_explicit_{record}.log",
    params:
        building=BUILDING.keys(),
    script:
        "../scripts/building/table_building_explicit.py"


rule building_explicit_cost:
    input:
        scene="results/{run}/building/explicit_scene_{coarsening}.json",
        record=lambda w: f"results/{w.run}/records/{BUILDING.records(w.run, 'wme_records')[0]}.csv",
        yade="results/{run}/yade.txt",
        modules=study_code("explicit_building"),
    output:
        history=temp("results/{run}/building/explicit_cost_{coarsening}.csv"),
        cost="results/{run}/building/explicit_cost_{coarsening}.json",
    log:
        "results/{run}/logs/building_explicit_cost_{coarsening}.log",
    params:
        yade=YADE,
        steps=lambda w: STUDY.cfg(w)["building"]["explicit_cost_steps"],
    shell:
        "{params.yade} explicit_building --scene {input.scene:q} --motion {input.record:q}"
        " --steps {params.steps} --output {output.history:q} --cost {output.cost:q}"
        " 2> {log:q}"


rule table_building_explicit_cost:
    input:
        cost=BUILDING.explicit_costs,
        modules=code("building/table_building_explicit_cost"),
    output:
        shown(
            "results/{run}/tables/building_explicit_cost.csv",
            "fig03_cost",
            "Building",
            "cost of the explicit run (CSV)",
        ),
    log:
        "results/{run}/logs/table_building_explicit_cost.log",
    params:
        coarsenings=lambda w: STUDY.cfg(w)["building"]["explicit_convergence"],
    script:
        "../scripts/building/table_building_explicit_cost.py"


rule table_claims_building:
    input:
        modes="results/{run}/tables/building_modes.csv",
        wme="results/{run}/tables/wme.csv",
        explicit=BUILDING.explicit_tables,
        modules=code("building/table_claims_building"),
    output:
        shown(
            "results/{run}/tables/claims_building.csv",
            "table_claims_building",
            "Building",
            "claims of the study's section 2 (CSV)",
        ),
    log:
        "results/{run}/logs/table_claims_building.log",
    script:
        "../scripts/building/table_claims_building.py"
