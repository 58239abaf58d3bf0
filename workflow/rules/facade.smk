# Scene files: what a façade run depends on, as plain data.


rule scene:
    input:
        modules=module("workflow/rocking/calibration.py", "workflow/rocking/closed_forms.py"),
    output:
        "results/{run}/scenes/{model}.json",
    params:
        scene=params_of(
            "facade", "return_wall", "damping", "smdof", "numerics", "ida", "ensemble"
        ),
    log:
        "results/{run}/logs/scene_{model}.log",
    script:
        "../scripts/scene.py"


# One early job that says in one line whether this machine can run YADE scenes.
rule yade_check:
    input:
        modules=module("yade_scripts/engine.py", "yade_scripts/check_yade.py"),
    output:
        "results/{run}/yade.txt",
    log:
        "results/{run}/logs/yade_check.log",
    params:
        python=YADE_PYTHON,
        check=str(BASE / "yade_scripts" / "check_yade.py"),
    shell:
        "{params.python:q} {params.check:q} --output {output:q} 2> >(tee {log:q} >&2)"
