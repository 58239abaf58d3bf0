# The complete building: brick model, façade cracked off (CB) or bonded (CBc). Not part of the main
# job; ask for `complete`.
wildcard_constraints:
    complete="|".join(COMPLETE.models),
    back="bricks|facade",


COMPLETE_SECTIONS = STUDY.params_of(
    "facade",
    "return_wall",
    "damping",
    "numerics",
    "building",
    "complete",
    "ida.max_pga_g",
)


rule complete:
    input:
        lambda w: with_pages(STUDY.per_run(COMPLETE.results)),


rule complete_scene:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        fidelity=FIDELITY_FILE,
        law=LAW_FILE,
        modules=code("complete/complete_scene"),
    output:
        "results/{run}/complete/scenes/{complete}_{coarsening}_{back}.json",
    log:
        "results/{run}/logs/complete_scene_{complete}_{coarsening}_{back}.log",
    params:
        config=COMPLETE_SECTIONS,
    script:
        "../scripts/complete/complete_scene.py"


rule complete_scan:
    input:
        plan=BUILDING.plan,
        fit="results/{run}/building/fit.json",
        fidelity=FIDELITY_FILE,
        law=LAW_FILE,
        motion=STUDY.ida_motion,
        modules=code("complete/complete_scan"),
    output:
        "results/{run}/screening/{complete}/{record}_{direction}.csv",
    log:
        "results/{run}/logs/complete_scan_{complete}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/complete_scan_{complete}_{record}_{direction}.tsv"
    params:
        config=COMPLETE_SECTIONS,
        settings=lambda w: {
            **{key: STUDY.cfg(w)["ida"][key] for key in ("beyond", "max_pga_g")},
            "amplitude_spread": STUDY.cfg(w)["ensemble"]["amplitude_spread"],
        },
    script:
        "../scripts/complete/complete_scan.py"


rule complete_plan:
    input:
        scan="results/{run}/screening/{complete}/{record}_{direction}.csv",
        modules=code("complete/complete_plan"),
    output:
        "results/{run}/complete/plans/{complete}_{record}_{direction}.json",
    log:
        "results/{run}/logs/complete_plan_{complete}_{record}_{direction}.log",
    params:
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
        step=lambda w: COMPLETE.settings(w.run)["level_ratio"],
        most=lambda w: STUDY.cfg(w)["ida"]["max_islands"],
    script:
        "../scripts/complete/complete_plan.py"


rule complete_ida:
    input:
        scene=COMPLETE.scene,
        motion=STUDY.ida_motion,
        plan="results/{run}/complete/plans/{complete}_{record}_{direction}.json",
        yade="results/{run}/yade.txt",
        modules=study_code("complete"),
    output:
        "results/{run}/ida/{complete}/{record}_{direction}.csv",
    log:
        "results/{run}/logs/complete_ida_{complete}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/complete_ida_{complete}_{record}_{direction}.tsv"
    params:
        yade=YADE,
        journal="results/{run}/cache/complete/{complete}_{record}_{direction}.jsonl",
    shell:
        "{params.yade} complete --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction} --plan {input.plan:q}"
        " --journal {params.journal:q} --output {output:q} 2> {log:q}"


# A short push of the ground, and then nothing: the building rings.
rule complete_pulse:
    input:
        modules=code("complete/complete_pulse"),
    output:
        "results/{run}/complete/pulse.csv",
    log:
        "results/{run}/logs/complete_pulse.log",
    script:
        "../scripts/complete/complete_pulse.py"


rule complete_history:
    input:
        scene="results/{run}/complete/scenes/{complete}_{coarsening}_{back}.json",
        motion=COMPLETE.motion,
        yade="results/{run}/yade.txt",
        modules=study_code("complete_history"),
    output:
        history="results/{run}/complete/histories/{complete}_{coarsening}_{back}_{kind}.csv",
        cost="results/{run}/complete/histories/{complete}_{coarsening}_{back}_{kind}.json",
    log:
        "results/{run}/logs/complete_history_{complete}_{coarsening}_{back}_{kind}.log",
    wildcard_constraints:
        kind="linear|ring|apart|level",
    params:
        yade=YADE,
        how=COMPLETE.how,
    shell:
        "{params.yade} complete_history --scene {input.scene:q} --motion {input.motion:q}"
        " {params.how} --output {output.history:q} --cost {output.cost:q} 2> {log:q}"


rule table_complete_checks:
    input:
        scene=COMPLETE.scenes_of("CBc"),
        linear=COMPLETE.histories_of("CBc", "linear"),
        ring=COMPLETE.histories_of("CBc", "ring"),
        apart=COMPLETE.histories_of("CBc", "apart"),
        motion=COMPLETE.check_motion,
        pulse="results/{run}/complete/pulse.csv",
        modules=code("complete/table_complete_checks"),
    output:
        shown(
            "results/{run}/tables/complete_checks.csv",
            "complete_checks",
            "Complete building",
            "periods and linear answer (CSV)",
        ),
    log:
        "results/{run}/logs/table_complete_checks.log",
    params:
        direction=lambda w: COMPLETE.settings(w.run)["check_direction"],
        pga_g=lambda w: COMPLETE.settings(w.run)["linear_pga_g"],
    script:
        "../scripts/complete/table_complete_checks.py"


rule table_complete_convergence:
    input:
        scenes=COMPLETE.levels("scenes", ".json"),
        costs=COMPLETE.levels("histories", "_level.json"),
        histories=COMPLETE.levels("histories", "_level.csv"),
        modules=code("complete/table_complete_convergence"),
    output:
        shown(
            "results/{run}/tables/complete_convergence.csv",
            "complete_convergence",
            "Complete building",
            "brick size and back joint (CSV)",
        ),
    log:
        "results/{run}/logs/table_complete_convergence.log",
    script:
        "../scripts/complete/table_complete_convergence.py"


rule complete_collapse:
    input:
        ida=lambda w: COMPLETE.curves(w.run),
        scans=lambda w: COMPLETE.scans(w.run),
        modules=code("complete/table_complete_collapse"),
    output:
        collapse="results/{run}/tables/complete_collapse.csv",
        probability="results/{run}/tables/complete_probability.csv",
    log:
        "results/{run}/logs/complete_collapse.log",
    params:
        spread=lambda w: STUDY.cfg(w)["ensemble"]["amplitude_spread"],
    script:
        "../scripts/complete/table_complete_collapse.py"


rule figure_complete:
    input:
        ida=lambda w: COMPLETE.curves(w.run),
        scans=lambda w: COMPLETE.scans(w.run) + COMPLETE.twins(w.run),
        facts=STUDY.record_facts,
        modules=code("complete/figure_complete"),
    output:
        **figure("complete_ida", "Complete building", "IDA of the complete building"),
    log:
        "results/{run}/logs/figure_complete.log",
    script:
        "../scripts/complete/figure_complete.py"


rule complete_frames:
    input:
        scene=COMPLETE.scene,
        motion=STUDY.ida_motion,
        curve="results/{run}/ida/{complete}/{record}_{direction}.csv",
        yade="results/{run}/yade.txt",
        modules=study_code("complete_history"),
    output:
        history="results/{run}/complete/collapse/{complete}_{record}_{direction}.csv",
        cost="results/{run}/complete/collapse/{complete}_{record}_{direction}.json",
        frames="results/{run}/complete/collapse/{complete}_{record}_{direction}_frames.json",
    log:
        "results/{run}/logs/complete_frames_{complete}_{record}_{direction}.log",
    params:
        yade=YADE,
    shell:
        "{params.yade} complete_history --scene {input.scene:q} --motion {input.motion:q}"
        " --direction {wildcards.direction} --collapse {input.curve:q} --fall 6"
        " --frames {output.frames:q} --output {output.history:q} --cost {output.cost:q}"
        " 2> {log:q}"


rule figure_complete_collapse:
    input:
        frames="results/{run}/complete/collapse/{complete}_{record}_{direction}_frames.json",
        facts="results/{run}/records/{record}.json",
        modules=code("complete/figure_complete_collapse"),
    output:
        **figure(
            "complete_collapse_{complete}_{record}_{direction}",
            "Complete building",
            "{complete}: side views of the lowest collapse",
            about="complete_collapse",
            record="{record}",
        ),
    log:
        "results/{run}/logs/figure_complete_collapse_{complete}_{record}_{direction}.log",
    script:
        "../scripts/complete/figure_complete_collapse.py"
