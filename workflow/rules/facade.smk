# Case files: what a façade run depends on, as plain data.


def mass_of_walls(wildcards):
    """File with the building's mass, where a model's walls carry it and none is stated."""
    stated = RUNS.cfg(wildcards)["return_wall"]["building_mass_kg"]
    needed = MODELS[wildcards.model].two_way and stated is None
    return [of_run(rules.building_fit.output[0])(wildcards)] if needed else []


rule facade_case:
    input:
        fidelity=FIDELITY_FILE,
        law=LAW_FILE,
        building=mass_of_walls,
    output:
        results("cases/{model}.json"),
    params:
        sections=lambda w: RUNS.params_of(
            *SECTIONS, *(["w3"] if MODELS[w.model].walls == "bricks" else [])
        )(w),
    script:
        "../scripts/ida/facade_case.py"


# One early job that says in one line whether this machine can run YADE scenes.
rule yade_check:
    input:
        modules=command_code("check_yade"),
    output:
        results("yade.txt"),
    log:
        logs("yade_check"),
    priority: 100  # a YADE that does not run is said at once
    params:
        yade=YADE,
    shell:
        "{params.yade} check_yade --output {output:q} 2> {log:q}"
