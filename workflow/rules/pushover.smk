# Static capacity curves in YADE: one job a model, and one a variant of W3.
PUSH_SECTIONS = (
    "facade",
    "return_wall",
    "damping",
    "smdof",
    "numerics",
    "pushover",
    "w3",
)


wildcard_constraints:
    pushed="|".join(PUSHED),
    variant="|".join(re.escape(name) for name in VARIANTS),


rule pushover_scene:
    input:
        law=LAW_FILE,
        modules=code("pushover/pushover_scene"),
    output:
        "results/{run}/pushover/scenes/{pushed}.json",
    log:
        "results/{run}/logs/pushover_scene_{pushed}.log",
    params:
        scene=STUDY.params_of(*PUSH_SECTIONS),
    script:
        "../scripts/pushover/pushover_scene.py"


rule pushover_variant_scene:
    input:
        law=LAW_FILE,
        modules=code("pushover/pushover_scene"),
    output:
        "results/{run}/w3/scenes/{variant}.json",
    log:
        "results/{run}/logs/w3_scene_{variant}.log",
    params:
        scene=STUDY.params_of(*PUSH_SECTIONS),
    script:
        "../scripts/pushover/pushover_scene.py"


rule pushover:
    input:
        scene="results/{run}/pushover/scenes/{pushed}.json",
        yade="results/{run}/yade.txt",
        modules=study_code("pushover"),
    output:
        curve="results/{run}/pushover/raw/{pushed}.csv",
        forces="results/{run}/pushover/raw/{pushed}_forces.csv",
    log:
        "results/{run}/logs/pushover_{pushed}.log",
    benchmark:
        "results/{run}/benchmarks/pushover_{pushed}.tsv"
    params:
        yade=YADE,
    shell:
        "{params.yade} pushover --scene {input.scene:q} --output {output.curve:q}"
        " --forces {output.forces:q} 2> {log:q}"


rule pushover_variant:
    input:
        scene="results/{run}/w3/scenes/{variant}.json",
        yade="results/{run}/yade.txt",
        modules=study_code("pushover"),
    output:
        curve="results/{run}/w3/{variant}.csv",
        forces="results/{run}/w3/{variant}_forces.csv",
    log:
        "results/{run}/logs/w3_{variant}.log",
    benchmark:
        "results/{run}/benchmarks/w3_{variant}.tsv"
    params:
        yade=YADE,
    shell:
        "{params.yade} pushover --scene {input.scene:q} --output {output.curve:q}"
        " --forces {output.forces:q} 2> {log:q}"


rule pushover_curve:
    input:
        scene="results/{run}/pushover/scenes/{pushed}.json",
        raw="results/{run}/pushover/raw/{pushed}.csv",
        modules=code("pushover/pushover_curve"),
    output:
        "results/{run}/pushover/{pushed}.csv",
    log:
        "results/{run}/logs/pushover_curve_{pushed}.log",
    script:
        "../scripts/pushover/pushover_curve.py"


rule table_pushover:
    input:
        curves=BOUNDARY.pushover_curves,
        scenes=BOUNDARY.variants("scenes/{}.json"),
        raw=BOUNDARY.variants("{}.csv"),
        forces=BOUNDARY.variants("{}_forces.csv"),
        modules=code("pushover/table_pushover"),
    output:
        shown(
            "results/{run}/tables/pushover.csv",
            "table_pushover",
            "Boundary conditions",
            "static capacities (CSV)",
        ),
    log:
        "results/{run}/logs/table_pushover.log",
    script:
        "../scripts/pushover/table_pushover.py"


rule fig08_w3:
    input:
        scenes=BOUNDARY.drawn_variants("scenes/{}.json"),
        raw=BOUNDARY.drawn_variants("{}.csv"),
        forces=BOUNDARY.drawn_variants("{}_forces.csv"),
        modules=code("pushover/fig08_w3"),
    output:
        **figure(
            "fig08_w3",
            "Boundary conditions",
            "8: W3 and its capacity curve",
            about="fig08",
        ),
    log:
        "results/{run}/logs/fig08_w3.log",
    script:
        "../scripts/pushover/fig08_w3.py"


rule figure_w3_sensitivity:
    input:
        table="results/{run}/tables/pushover.csv",
        modules=code("pushover/figure_w3_sensitivity"),
    output:
        **figure(
            "w3_sensitivity", "Boundary conditions", "sensitivity of W3's capacity"
        ),
    log:
        "results/{run}/logs/w3_sensitivity.log",
    script:
        "../scripts/pushover/figure_w3_sensitivity.py"
