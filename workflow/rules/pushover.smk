# Static capacity curves in YADE: one job a model, and one a variant of W3.
include: "boundary_targets.smk"


PUSH_SECTIONS = (
    "facade",
    "return_wall",
    "damping",
    "smdof",
    "numerics",
    "pushover",
    "w3",
)
PUSH_MODULES = yade_modules() + module("yade_scripts/studies/pushover.py")
PUSH_SCRIPTS = module(
    "workflow/rocking/curves/pushover.py", "workflow/rocking/mechanics/closed_forms.py"
)


wildcard_constraints:
    pushed="free|W1|W1c|W3",
    variant="|".join(re.escape(name) for name in W3_VARIANTS),


rule pushover_scene:
    input:
        modules=module("workflow/rocking/calibration/beta.py") + PUSH_SCRIPTS,
    output:
        "results/{run}/pushover/scenes/{pushed}.json",
    log:
        "results/{run}/logs/pushover_scene_{pushed}.log",
    params:
        scene=params_of(*PUSH_SECTIONS),
    script:
        "../scripts/pushover_scene.py"


rule pushover_variant_scene:
    input:
        modules=module("workflow/rocking/calibration/beta.py") + PUSH_SCRIPTS,
    output:
        "results/{run}/w3/scenes/{variant}.json",
    log:
        "results/{run}/logs/w3_scene_{variant}.log",
    params:
        scene=params_of(*PUSH_SECTIONS),
    script:
        "../scripts/pushover_scene.py"


rule pushover:
    input:
        entry=module("yade_scripts/studies/pushover.py"),
        scene="results/{run}/pushover/scenes/{pushed}.json",
        yade="results/{run}/yade.txt",
        modules=PUSH_MODULES,
    output:
        curve="results/{run}/pushover/raw/{pushed}.csv",
        forces="results/{run}/pushover/raw/{pushed}_forces.csv",
    log:
        "results/{run}/logs/pushover_{pushed}.log",
    benchmark:
        "results/{run}/benchmarks/pushover_{pushed}.tsv"
    params:
        python=YADE_PYTHON,
    shell:
        "{params.python:q} {input.entry:q} --scene {input.scene:q} --output {output.curve:q}"
        " --forces {output.forces:q} 2> >(tee {log:q} >&2)"


rule pushover_variant:
    input:
        entry=module("yade_scripts/studies/pushover.py"),
        scene="results/{run}/w3/scenes/{variant}.json",
        yade="results/{run}/yade.txt",
        modules=PUSH_MODULES,
    output:
        curve="results/{run}/w3/{variant}.csv",
        forces="results/{run}/w3/{variant}_forces.csv",
    log:
        "results/{run}/logs/w3_{variant}.log",
    benchmark:
        "results/{run}/benchmarks/w3_{variant}.tsv"
    params:
        python=YADE_PYTHON,
    shell:
        "{params.python:q} {input.entry:q} --scene {input.scene:q} --output {output.curve:q}"
        " --forces {output.forces:q} 2> >(tee {log:q} >&2)"


rule pushover_curve:
    input:
        scene="results/{run}/pushover/scenes/{pushed}.json",
        raw="results/{run}/pushover/raw/{pushed}.csv",
        modules=PUSH_SCRIPTS,
    output:
        "results/{run}/pushover/{pushed}.csv",
    log:
        "results/{run}/logs/pushover_curve_{pushed}.log",
    script:
        "../scripts/pushover_curve.py"


rule table_pushover:
    input:
        curves=lambda w: pushover_curves(w.run),
        scenes=lambda w: variant_files(w.run, "scenes/{}.json"),
        raw=lambda w: variant_files(w.run, "{}.csv"),
        forces=lambda w: variant_files(w.run, "{}_forces.csv"),
        modules=PUSH_SCRIPTS,
    output:
        report(
            "results/{run}/tables/pushover.csv",
            caption=caption("table_pushover"),
            category="Boundary conditions",
            labels={"run": "{run}", "result": "static capacities (CSV)"},
        ),
    log:
        "results/{run}/logs/table_pushover.log",
    script:
        "../scripts/table_pushover.py"


rule fig08_w3:
    input:
        scenes=lambda w: variant_files(
            w.run,
            "scenes/{}.json",
            [f"header_{r}" for r in HEADER_RULES] + ["default"],
        ),
        raw=lambda w: variant_files(
            w.run, "{}.csv", [f"header_{r}" for r in HEADER_RULES] + ["default"]
        ),
        forces=lambda w: variant_files(
            w.run, "{}_forces.csv", [f"header_{r}" for r in HEADER_RULES] + ["default"]
        ),
        style=STYLE,
        modules=PUSH_SCRIPTS,
    output:
        png=report(
            "results/{run}/figures/fig08_w3.png",
            caption=caption("fig08"),
            category="Boundary conditions",
            labels={"run": "{run}", "result": "8: W3 and its capacity curve"},
        ),
        pdf="results/{run}/figures/fig08_w3.pdf",
    log:
        "results/{run}/logs/fig08_w3.log",
    script:
        "../scripts/fig08_w3.py"


rule figure_w3_sensitivity:
    input:
        table="results/{run}/tables/pushover.csv",
        style=STYLE,
    output:
        png=report(
            "results/{run}/figures/w3_sensitivity.png",
            caption=caption("w3_sensitivity"),
            category="Boundary conditions",
            labels={"run": "{run}", "result": "sensitivity of W3's capacity"},
        ),
        pdf="results/{run}/figures/w3_sensitivity.pdf",
    log:
        "results/{run}/logs/w3_sensitivity.log",
    script:
        "../scripts/figure_w3_sensitivity.py"
