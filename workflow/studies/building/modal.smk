# The brick building as a plan: the load of its floors that gives its period, its mass, its modes.
BRICK_MODEL = (
    "brick_length_m",
    "brick_height_m",
    "brick_width_m",
    "coarsening",
    *(f"{joint}_{k}_pa_m" for joint in ("head", "bed", "collar", "timber") for k in ("jkn", "jks")),
    "density_kg_m3",
    "timber_density_kg_m3",
    "fit_period_s",
)


wildcard_constraints:
    building="CBDEM|SBDEM",


def plan_file(wildcards):
    """Plan of the building of a run."""
    path = RUNS.key("building.plan")(wildcards.run)
    there = RUNS.find_file(path)
    if not Path(there).exists():
        raise SystemExit(f"error: building.plan: there is no file '{path}'")
    return there


rule building_fit:
    input:
        plan=plan_file,
    output:
        results("building/fit.json"),
    benchmark:
        benchmarks("building_fit")
    params:
        building=values_of("building", *BRICK_MODEL),
    script:
        "scripts/building_fit.py"


rule building_modal:
    input:
        plan=plan_file,
        fit=rules.building_fit.output[0],
    output:
        results("building/{building}_modes.npz"),
    benchmark:
        benchmarks("building_modal_{building}")
    params:
        building=values_of("building", *BRICK_MODEL, "modes"),
    script:
        "scripts/building_modal.py"


# What others take of it: the mass behind the façade, and T1 with and without façades.
rule building_stage:
    input:
        fit=rules.building_fit.output[0],
        cbdem=of_run(rules.building_modal.output[0], building="CBDEM"),
        sbdem=of_run(rules.building_modal.output[0], building="SBDEM"),
    output:
        results("building/stage.json"),
    script:
        "scripts/building_stage.py"


OF_BUILDING["mass"] = of_run(rules.building_fit.output[0])
OF_BUILDING["stage"] = of_run(rules.building_stage.output[0])
