# Scene files: what a façade run depends on, as plain data.


rule scene:
    input:
        fidelity=FIDELITY_FILE,
        law=LAW_FILE,
        building=lambda w: BUILDING.mass_of_walls(w),
        modules=code("ida/scene"),
    output:
        "results/{run}/scenes/{model}.json",
    log:
        "results/{run}/logs/scene_{model}.log",
    params:
        scene=lambda w: STUDY.params_of(
            "facade",
            "return_wall",
            "damping",
            "smdof",
            "numerics",
            "ida",
            "ensemble",
            *(["w3"] if MODELS[w.model].walls == "bricks" else []),
        )(w),
    script:
        "../scripts/ida/scene.py"


# One early job that says in one line whether this machine can run YADE scenes.
rule yade_check:
    input:
        modules=study_code("check_yade"),
    output:
        "results/{run}/yade.txt",
    log:
        "results/{run}/logs/yade_check.log",
    priority: 100  # a YADE that does not run is said at once
    params:
        yade=YADE,
    shell:
        "{params.yade} check_yade --output {output:q} 2> {log:q}"
