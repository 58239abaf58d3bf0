# Scene files: what a façade run depends on, as plain data.


rule scene:
    input:
        modules=module(
            "workflow/rocking/accuracy/study.py",
            "workflow/rocking/calibration/beta.py",
            "workflow/rocking/mechanics/closed_forms.py",
        ),
        fidelity=str(BASE / "config" / "fidelity.yaml"),
    output:
        "results/{run}/scenes/{model}.json",
    log:
        "results/{run}/logs/scene_{model}.log",
    params:
        scene=lambda w: params_of(
            "facade",
            "return_wall",
            "damping",
            "smdof",
            "numerics",
            "ida",
            "ensemble",
            *(["w3"] if w.model == "W3" else []),
        )(w),
    script:
        "../scripts/scene.py"


# One early job that says in one line whether this machine can run YADE scenes.
rule yade_check:
    input:
        entry=module("yade_scripts/studies/check_yade.py"),
        modules=module("yade_scripts/engine/adapter.py"),
    output:
        "results/{run}/yade.txt",
    log:
        "results/{run}/logs/yade_check.log",
    params:
        python=YADE_PYTHON,
    shell:
        "{params.python:q} {input.entry:q} --output {output:q} 2> >(tee {log:q} >&2)"
