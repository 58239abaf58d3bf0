# The building as an assembly of bricks: modes, time histories, equal chains, explicit check.
# Not part of the main job; ask for `building`, or for any file below.
include: "building_targets.smk"


wildcard_constraints:
    building="CBDEM|SBDEM",
    coarsening=r"[0-9.]+",


rule building:
    input:
        lambda w: with_pages(per_run(building_results)),


# Periods and equivalent chain (n, T1) of any plan, without the paper's comparisons.
rule building_t1:
    input:
        lambda w: with_pages(per_run(building_periods)),


rule building_fit:
    input:
        plan=building_plan,
        modules=building_modules(),
    output:
        "results/{run}/building/fit.json",
    log:
        "results/{run}/logs/building_fit.log",
    benchmark:
        "results/{run}/benchmarks/building_fit.tsv"
    params:
        building=building_keys(),
    script:
        "../scripts/building_fit.py"


rule building_modal:
    input:
        plan=building_plan,
        fit="results/{run}/building/fit.json",
        modules=building_modules(),
    output:
        "results/{run}/building/{building}_modes.npz",
    log:
        "results/{run}/logs/building_modal_{building}.log",
    benchmark:
        "results/{run}/benchmarks/building_modal_{building}.tsv"
    params:
        building=building_keys("modes"),
    script:
        "../scripts/building_modal.py"


rule table_building_modes:
    input:
        cbdem="results/{run}/building/CBDEM_modes.npz",
        sbdem="results/{run}/building/SBDEM_modes.npz",
    output:
        report(
            "results/{run}/tables/building_modes.csv",
            caption=caption("fig02_table"),
            category="Building",
            labels={"run": "{run}", "result": "periods and effective masses (CSV)"},
        ),
    log:
        "results/{run}/logs/table_building_modes.log",
    params:
        paper=is_case_study,
    script:
        "../scripts/table_building_modes.py"


rule table_building_alternatives:
    input:
        plans=all_plans,
        modules=building_modules(),
    output:
        report(
            "results/{run}/tables/building_alternatives.csv",
            caption=caption("fig02_alternatives"),
            category="Building",
            labels={"run": "{run}", "result": "periods of alternative plans (CSV)"},
        ),
    log:
        "results/{run}/logs/table_building_alternatives.log",
    params:
        building=building_keys(),
    script:
        "../scripts/table_building_alternatives.py"


rule building_cost:
    input:
        plan=building_plan,
        fit="results/{run}/building/fit.json",
        modules=building_modules(),
    output:
        "results/{run}/building/cost_{building}_{coarsening}.json",
    log:
        "results/{run}/logs/building_cost_{building}_{coarsening}.log",
    benchmark:
        "results/{run}/benchmarks/building_cost_{building}_{coarsening}.tsv"
    resources:
        mem_mb=lambda w: 6000 if float(w.coarsening) < 1.2 else 1500,
    params:
        building=building_keys(),
    script:
        "../scripts/building_cost.py"


rule table_building_convergence:
    input:
        cost=lambda w: [
            f"results/{w.run}/building/cost_{model}_{c:g}.json"
            for model in ("CBDEM", "SBDEM")
            for c in cfg(w)["building"]["convergence"]
        ],
    output:
        report(
            "results/{run}/tables/building_convergence.csv",
            caption=caption("fig02_convergence"),
            category="Building",
            labels={
                "run": "{run}",
                "result": "convergence and cost of the modes (CSV)",
            },
        ),
    log:
        "results/{run}/logs/table_building_convergence.log",
    script:
        "../scripts/table_building_convergence.py"


rule building_history:
    input:
        plan=building_plan,
        fit="results/{run}/building/fit.json",
        modes="results/{run}/building/{building}_modes.npz",
        record="results/{run}/records/{record}.csv",
        modules=building_modules(
            "workflow/rocking/building/history.py", "smdof/oscillator.py"
        ),
    output:
        "results/{run}/building/history_{building}_{record}.csv",
    log:
        "results/{run}/logs/building_history_{building}_{record}.log",
    params:
        building=building_keys("damping_ratio"),
    script:
        "../scripts/building_history.py"


rule table_wme:
    input:
        modes="results/{run}/building/SBDEM_modes.npz",
        histories=lambda w: [
            f"results/{w.run}/building/history_SBDEM_{r}.csv"
            for r in wme_records(w.run)
        ],
        records=lambda w: [
            f"results/{w.run}/records/{r}.csv" for r in wme_records(w.run)
        ],
        modules=module(
            "workflow/rocking/building/comparison.py", "smdof/chain.py", "smdof/wme.py"
        ),
    output:
        wme=report(
            "results/{run}/tables/wme.csv",
            caption=caption("fig03_table"),
            category="Building",
            labels={
                "run": "{run}",
                "result": "2: weighted mean error of chains (CSV)",
            },
        ),
        chain="results/{run}/tables/building_chain.csv",
        config="results/{run}/building/chain.yaml",
    log:
        "results/{run}/logs/table_wme.log",
    params:
        building=lambda w: {k: cfg(w)["building"][k] for k in WME_KEYS},
        records=lambda w: wme_records(w.run),
        paper=is_case_study,
    script:
        "../scripts/table_wme.py"


rule fig01_building:
    input:
        plan=building_plan,
        style=STYLE,
        modules=building_modules("workflow/rocking/building/drawing.py"),
    output:
        png=report(
            "results/{run}/figures/fig01_building.png",
            caption=caption("fig01"),
            category="Building",
            labels={"run": "{run}", "result": "1: brick models"},
        ),
        pdf="results/{run}/figures/fig01_building.pdf",
    log:
        "results/{run}/logs/fig01_building.log",
    params:
        building=building_keys(),
    script:
        "../scripts/fig01_building.py"


rule fig02_modes:
    input:
        plan=building_plan,
        fit="results/{run}/building/fit.json",
        cbdem="results/{run}/building/CBDEM_modes.npz",
        sbdem="results/{run}/building/SBDEM_modes.npz",
        style=STYLE,
        modules=building_modules("workflow/rocking/building/drawing.py"),
    output:
        png=report(
            "results/{run}/figures/fig02_modes.png",
            caption=caption("fig02"),
            category="Building",
            labels={"run": "{run}", "result": "2: modes"},
        ),
        pdf="results/{run}/figures/fig02_modes.pdf",
    log:
        "results/{run}/logs/fig02_modes.log",
    params:
        building=building_keys(),
        paper=is_case_study,
    script:
        "../scripts/fig02_modes.py"


rule fig03_wme:
    input:
        modes="results/{run}/building/SBDEM_modes.npz",
        history="results/{run}/building/history_SBDEM_{record}.csv",
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
        style=STYLE,
        modules=module(
            "workflow/rocking/building/comparison.py", "smdof/chain.py", "smdof/wme.py"
        ),
    output:
        png=report(
            "results/{run}/figures/fig03_{record}.png",
            caption=caption("fig03"),
            category="Building",
            labels={
                "run": "{run}",
                "record": "{record}",
                "result": "3: SBDEM and equal chains",
            },
        ),
        pdf="results/{run}/figures/fig03_{record}.pdf",
    log:
        "results/{run}/logs/fig03_{record}.log",
    params:
        building=lambda w: {k: cfg(w)["building"][k] for k in WME_KEYS},
    script:
        "../scripts/fig03_wme.py"


rule building_explicit_scene:
    input:
        plan=building_plan,
        fit="results/{run}/building/fit.json",
        modules=building_modules(),
    output:
        "results/{run}/building/explicit_scene_{coarsening}.json",
    log:
        "results/{run}/logs/building_explicit_scene_{coarsening}.log",
    params:
        building=building_keys(
            "damping_ratio", "explicit_step_fraction", "explicit_duration_s"
        ),
    script:
        "../scripts/building_explicit_scene.py"


# The drawing's building under the record, with its dead load applied at once or left out.
rule building_explicit:
    input:
        entry=module("yade_scripts/studies/explicit_building.py"),
        scene=explicit_scene,
        record="results/{run}/records/{record}.csv",
        yade="results/{run}/yade.txt",
        modules=module(
            "yade_scripts/engine/adapter.py",
            "yade_scripts/model/scene.py",
        ),
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
        python=YADE_PYTHON,
        gravity=lambda w: 9.81 if w.load == "loaded" else 0.0,
    shell:
        "{params.python:q} {input.entry:q} --scene {input.scene:q} --motion {input.record:q}"
        " --gravity {params.gravity} --output {output.history:q} --cost {output.cost:q}"
        " 2> >(tee {log:q} >&2)"


rule table_building_explicit:
    input:
        plan=building_plan,
        fit="results/{run}/building/fit.json",
        scene=explicit_scene,
        plain="results/{run}/building/explicit_plain_{record}.csv",
        loaded="results/{run}/building/explicit_loaded_{record}.csv",
        record="results/{run}/records/{record}.csv",
        facts="results/{run}/records/{record}.json",
        style=STYLE,
        modules=building_modules(
            "workflow/rocking/building/history.py",
            "workflow/rocking/building/comparison.py",
        ),
    output:
        table="results/{run}/tables/building_explicit_{record}.csv",
        png=report(
            "results/{run}/figures/fig03_rattling_{record}.png",
            caption=caption("fig03_rattling"),
            category="Building",
            labels={
                "run": "{run}",
                "record": "{record}",
                "result": "explicit and modal, rattling",
            },
        ),
        pdf="results/{run}/figures/fig03_rattling_{record}.pdf",
    log:
        "results/{run}/logs/table_building_explicit_{record}.log",
    params:
        building=building_keys(),
    script:
        "../scripts/table_building_explicit.py"


rule building_explicit_cost:
    input:
        entry=module("yade_scripts/studies/explicit_building.py"),
        scene="results/{run}/building/explicit_scene_{coarsening}.json",
        record=lambda w: f"results/{w.run}/records/{wme_records(w.run)[0]}.csv",
        yade="results/{run}/yade.txt",
    output:
        history=temp("results/{run}/building/explicit_cost_{coarsening}.csv"),
        cost="results/{run}/building/explicit_cost_{coarsening}.json",
    log:
        "results/{run}/logs/building_explicit_cost_{coarsening}.log",
    params:
        python=YADE_PYTHON,
        steps=lambda w: cfg(w)["building"]["explicit_cost_steps"],
    shell:
        "{params.python:q} {input.entry:q} --scene {input.scene:q} --motion {input.record:q}"
        " --steps {params.steps} --output {output.history:q} --cost {output.cost:q}"
        " 2> >(tee {log:q} >&2)"


rule table_building_explicit_cost:
    input:
        cost=lambda w: [
            f"results/{w.run}/building/explicit_cost_{c:g}.json"
            for c in cfg(w)["building"]["explicit_convergence"]
        ],
    output:
        report(
            "results/{run}/tables/building_explicit_cost.csv",
            caption=caption("fig03_cost"),
            category="Building",
            labels={"run": "{run}", "result": "cost of the explicit run (CSV)"},
        ),
    log:
        "results/{run}/logs/table_building_explicit_cost.log",
    params:
        coarsenings=lambda w: cfg(w)["building"]["explicit_convergence"],
    script:
        "../scripts/table_building_explicit_cost.py"
