# Pictures of the models, and what the study says about boundary conditions.


rule frames:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=BOUNDARY.picture_motion,
        yade="results/{run}/yade.txt",
        modules=study_code("frames"),
    output:
        "results/{run}/frames/{model}.json",
    log:
        "results/{run}/logs/frames_{model}.log",
    params:
        yade=YADE,
        record=lambda w: BOUNDARY.picture_record(w.run),
        direction=lambda w: STUDY.cfg(w)["pictures"]["direction"],
        pga=lambda w: STUDY.cfg(w)["pictures"]["pga_g"],
    shell:
        "{params.yade} frames --scene {input.scene:q} --motion {input.motion:q}"
        " --record {params.record:q} --direction {params.direction:q} --pga {params.pga:q}"
        " --fall 2 --output {output:q} 2> {log:q}"


rule collapse_frames:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=BOUNDARY.picture_motion,
        ida=BOUNDARY.picture_curve,
        modules=study_code("frames"),
    output:
        "results/{run}/frames/{model}_collapse.json",
    log:
        "results/{run}/logs/collapse_frames_{model}.log",
    params:
        yade=YADE,
        record=lambda w: BOUNDARY.picture_record(w.run),
        direction=lambda w: STUDY.cfg(w)["pictures"]["direction"],
        interval=lambda w: STUDY.cfg(w)["pictures"]["frame_interval_s"],
    shell:
        "{params.yade} frames --scene {input.scene:q} --motion {input.motion:q}"
        " --record {params.record:q} --direction {params.direction:q} --collapse {input.ida:q}"
        " --interval {params.interval:q} --fall 6 --output {output:q} 2> {log:q}"


rule fig07_models:
    input:
        frames=lambda w: [f"results/{w.run}/frames/{m}.json" for m in WITH_WALLS],
        facts=BOUNDARY.picture_facts,
        modules=code("boundary/fig07_models"),
    output:
        **figure(
            "fig07_models", "Boundary conditions", "7: the five models", about="fig07"
        ),
    log:
        "results/{run}/logs/fig07_models.log",
    params:
        config=STUDY.params_of("facade", "return_wall", "w3", "pictures"),
    script:
        "../scripts/boundary/fig07_models.py"


rule animation_collapse:
    input:
        frames="results/{run}/frames/{model}_collapse.json",
        facts=BOUNDARY.picture_facts,
        modules=code("history/animation_collapse"),
    output:
        shown(
            "results/{run}/figures/collapse_{model}.gif",
            "animation",
            "Boundary conditions",
            "collapse of {model}",
        ),
    log:
        "results/{run}/logs/animation_{model}.log",
    params:
        config=STUDY.params_of("facade", "return_wall", "w3", "pictures"),
    script:
        "../scripts/history/animation_collapse.py"


rule table_claims:
    input:
        collapse="results/{run}/tables/ida_collapse.csv",
        facts=STUDY.record_facts,
        pushover=lambda w: (
            ["results/{run}/pushover/W3.csv"] if "W3" in STUDY.cfg(w)["models"] else []
        ),
        modules=code("boundary/table_claims"),
    output:
        shown(
            "results/{run}/tables/claims.csv",
            "table_claims",
            "Boundary conditions",
            "claims of the study (CSV)",
        ),
    log:
        "results/{run}/logs/table_claims.log",
    params:
        w3=STUDY.params_of("w3"),
    script:
        "../scripts/boundary/table_claims.py"


# `snakemake --configfile config/scenarios/five_models.yaml -- boundary`: Figures 7, 8 and 9 whole.
rule boundary:
    input:
        with_pages(STUDY.per_run(BOUNDARY.results)),
