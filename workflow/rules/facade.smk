# Case files: what a façade run depends on, as plain data.


# What a study that models the building knows of it, as input functions: `mass`, a file with the mass behind the
# façade; `stage`, that and the building's first periods. Empty where there is no such study.
OF_BUILDING = {}


def mass_of_walls(wildcards):
    """File with the building's mass, where a model's walls carry it and none is stated."""
    stated = RUNS.cfg(wildcards)["return_wall"]["building_mass_kg"]
    if not MODELS[wildcards.model].two_way or stated is not None:
        return []
    if "mass" not in OF_BUILDING:
        stop(
            f"return_wall.building_mass_kg: null; {wildcards.model} takes the building's mass, and no study here"
            " finds it: expected a mass (kg)"
        )
    return [OF_BUILDING["mass"](wildcards)]


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
