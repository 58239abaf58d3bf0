# What the rules of the building read, and what makes up its results; functions only.

BUILDING_MODEL = (
    "brick_length_m brick_height_m brick_width_m coarsening head_jkn_pa_m head_jks_pa_m"
    " bed_jkn_pa_m bed_jks_pa_m collar_jkn_pa_m collar_jks_pa_m timber_jkn_pa_m timber_jks_pa_m"
    " density_kg_m3 timber_density_kg_m3 fit_period_s"
).split()
WME_KEYS = (
    "damping_ratio wme_longest_period_s wme_highest_frequency_hz wme_gain".split()
)


def building_keys(*more):
    """Params function: the keys of section `building` that a rule depends on."""
    return lambda w: {k: cfg(w)["building"][k] for k in (*BUILDING_MODEL, *more)}


def beside(path):
    """A file as given, or beside the Snakefile if it is not found there."""
    path = Path(path)
    return str(BASE / path if not path.exists() and (BASE / path).exists() else path)


def plan_file(key, path):
    """A plan file that exists; a missing one ends with one line."""
    found = beside(path)
    if not Path(found).exists():
        stop(f"building.{key}: there is no file '{path}'")
    return found


def building_plan(wildcards):
    """Plan file of a job's run."""
    return plan_file("plan", cfg(wildcards)["building"]["plan"])


def all_plans(wildcards):
    """Plan file of a job's run and the alternatives to it."""
    others = cfg(wildcards)["building"]["alternative_plans"]
    rest = [plan_file("alternative_plans", path) for path in others]
    return [building_plan(wildcards), *rest]


def is_case_study(wildcards):
    """True where the study's own figures belong beside the results."""
    return Path(cfg(wildcards)["building"]["plan"]).stem.startswith("case_study")


def building_modules(*more):
    """Source files of the assembly and its modes, and those given."""
    assembly = "__init__ plan bricks floors contacts assembly".split()
    return module(
        *(f"yade_scripts/building/{name}.py" for name in assembly),
        "yade_scripts/model/stiffness.py",
        "workflow/rocking/building/case.py",
        "workflow/rocking/building/modes.py",
        "workflow/rocking/building/ordering.py",
        *more,
    )


def building_records(run, key):
    """Records named by a key of section `building`; an unknown name ends with one line."""
    wanted = RUNS[run]["building"][key]
    for name in wanted:
        if name not in TABLES[run]:
            stop(
                f"building.{key}: '{name}' is not in {RUNS[run]['records_table']};"
                f" expected names from {', '.join(TABLES[run])}"
            )
    return wanted


def wme_records(run):
    """Records of the comparison with chains."""
    return building_records(run, "wme_records")


def building_results(run):
    """Everything the target `building` makes for one run."""
    folder, settings = f"results/{run}", RUNS[run]["building"]
    tables = (
        "building_modes wme building_chain building_convergence building_explicit_cost"
    )
    names = [f"tables/{name}.csv" for name in tables.split()]
    if settings["alternative_plans"]:
        names.append("tables/building_alternatives.csv")
    figures = ["fig01_building", "fig02_modes"]
    for record in wme_records(run):
        figures.append(f"fig03_{record}")
    for record in building_records(run, "explicit_records"):
        figures.append(f"fig03_rattling_{record}")
        names.append(f"tables/building_explicit_{record}.csv")
    return [
        f"{folder}/{name}"
        for name in names + [f"figures/{name}.png" for name in figures]
    ]


def explicit_scene(wildcards):
    """Scene of the explicit run."""
    coarsening = cfg(wildcards)["building"]["explicit_coarsening"]
    return f"results/{wildcards.run}/building/explicit_scene_{coarsening:g}.json"


def building_periods(run):
    """Periods and equivalent chain of a run's building."""
    names = ("building_modes", "building_chain")
    return [f"results/{run}/tables/{name}.csv" for name in names]
