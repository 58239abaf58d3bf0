# Fragility curves, efficiency of intensity measures, capacity reduction by the building.
# Not part of the main job; ask for `fragility` (from the run's curves) or `capacity_reduction`
# (further analyses).
wildcard_constraints:
    t1=r"[0-9.]+",
    below=r"\d+",


rule fragility:
    input:
        with_pages(STUDY.per_run(FRAGILITY.results)),
        STUDY.per_run(RISK.models_for_openquake),


rule capacity_reduction:
    input:
        with_pages(STUDY.per_run(FRAGILITY.reduction_results)),


rule fragility_table:
    input:
        collapse="results/{run}/tables/ida_collapse.csv",
        probability="results/{run}/tables/collapse_probability.csv",
        records=FRAGILITY.record_files,
        modules=code("fragility/fragility_table"),
    output:
        fragility="results/{run}/tables/fragility.csv",
        measures="results/{run}/tables/intensity_measures.csv",
        sufficiency="results/{run}/tables/im_sufficiency.csv",
        brackets="results/{run}/fragility/brackets.csv",
        curves="results/{run}/fragility/curves.csv",
    log:
        "results/{run}/logs/fragility_table.log",
    params:
        fragility=lambda w: STUDY.cfg(w)["fragility"],
        facade=lambda w: {
            k: STUDY.cfg(w)["facade"][k] for k in ("height_m", "thickness_m")
        },
        smdof=lambda w: {
            k: STUDY.cfg(w)["smdof"][k] for k in ("period_s", "damping_ratio")
        },
    script:
        "../scripts/fragility/fragility_table.py"


rule fragility_figure:
    input:
        fragility="results/{run}/tables/fragility.csv",
        curves="results/{run}/fragility/curves.csv",
        brackets="results/{run}/fragility/brackets.csv",
        facts=STUDY.record_facts,
        modules=code("fragility/fragility_figure"),
    output:
        **figure("fragility", "Fragility", "fragility curves"),
    log:
        "results/{run}/logs/fragility_figure.log",
    params:
        confidence=lambda w: STUDY.cfg(w)["fragility"]["confidence"],
        min_records=lambda w: STUDY.cfg(w)["fragility"]["min_records"],
        facade=lambda w: STUDY.cfg(w)["facade"],
        smdof=lambda w: STUDY.cfg(w)["smdof"],
    script:
        "../scripts/fragility/fragility_figure.py"


rule figure_intensity_measures:
    input:
        measures="results/{run}/tables/intensity_measures.csv",
        sufficiency="results/{run}/tables/im_sufficiency.csv",
        facts=STUDY.record_facts,
        modules=code("fragility/figure_intensity_measures"),
    output:
        **figure("intensity_measures", "Fragility", "efficiency of intensity measures"),
    log:
        "results/{run}/logs/figure_intensity_measures.log",
    params:
        confidence=lambda w: STUDY.cfg(w)["fragility"]["confidence"],
        min_records=lambda w: STUDY.cfg(w)["fragility"]["min_records"],
    script:
        "../scripts/fragility/figure_intensity_measures.py"


# The building's period and the façade's place in it, with the façade itself unchanged. A case is
# T<period>_below<masses>: a chain of masses_below + n_dof masses, the façade's base on mass
# number masses_below (on the ground for 0).
rule reduction_motion:
    input:
        record="results/{run}/records/{record}.csv",
        modules=code("capacity_reduction/capacity_reduction_motion"),
    output:
        motion="results/{run}/capacity_reduction/T{t1}_below{below}/{record}.csv",
        facts="results/{run}/capacity_reduction/T{t1}_below{below}/{record}.json",
    log:
        "results/{run}/logs/reduction_motion_T{t1}_below{below}_{record}.log",
    params:
        smdof=lambda w: {
            k: v for k, v in STUDY.cfg(w)["smdof"].items() if k != "period_s"
        },
    script:
        "../scripts/capacity_reduction/capacity_reduction_motion.py"


use rule screen as reduction_screen with:
    input:
        scene="results/{run}/scenes/W2.json",
        motion="results/{run}/capacity_reduction/T{t1}_below{below}/{record}.csv",
        modules=code("ida/screen"),
    output:
        scan="results/{run}/capacity_reduction/T{t1}_below{below}/scan_{record}_{direction}.csv",
        plan="results/{run}/capacity_reduction/T{t1}_below{below}/plan_{record}_{direction}.json",
    log:
        "results/{run}/logs/reduction_screen_T{t1}_below{below}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/reduction_screen_T{t1}_below{below}_{record}_{direction}.tsv"


use rule ida as reduction_ida with:
    input:
        scene="results/{run}/scenes/W2.json",
        motion="results/{run}/capacity_reduction/T{t1}_below{below}/{record}.csv",
        plan="results/{run}/capacity_reduction/T{t1}_below{below}/plan_{record}_{direction}.json",
        yade="results/{run}/yade.txt",
        modules=study_code("ida"),
    output:
        "results/{run}/capacity_reduction/T{t1}_below{below}/{record}_{direction}.csv",
    log:
        "results/{run}/logs/reduction_T{t1}_below{below}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/reduction_T{t1}_below{below}_{record}_{direction}.tsv"
    params:
        yade=YADE,
        plan=plan_option,
        journal="results/{run}/cache/reduction/T{t1}_below{below}_{record}_{direction}.jsonl",


rule figure_capacity_reduction:
    input:
        w1=lambda w: FRAGILITY.confirmed(w, FRAGILITY.reduction_reference(w)),
        w1_scans=FRAGILITY.reference_scans,
        w2=lambda w: FRAGILITY.confirmed(w, FRAGILITY.reduction_curves(w)),
        w2_scans=FRAGILITY.reduction_scans,
        facts=FRAGILITY.reduction_facts,
        records=STUDY.record_facts,
        modules=code("capacity_reduction/figure_capacity_reduction"),
    output:
        **figure(
            "capacity_reduction", "Capacity reduction", "W2/W1 against T1 and position"
        ),
        table="results/{run}/tables/capacity_reduction.csv",
    log:
        "results/{run}/logs/figure_capacity_reduction.log",
    params:
        w1=FRAGILITY.reduction_reference,
        w2=FRAGILITY.reduction_curves,
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
        facade=lambda w: STUDY.cfg(w)["facade"],
        smdof=lambda w: STUDY.cfg(w)["smdof"],
    script:
        "../scripts/capacity_reduction/figure_capacity_reduction.py"
