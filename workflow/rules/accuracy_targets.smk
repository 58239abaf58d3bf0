# Files of the accuracy study; functions only.


def accuracy_records(wildcards):
    """Records of the study; an unknown name is refused in one line."""
    wanted = cfg(wildcards)["accuracy"]["records"]
    unknown = [name for name in wanted if name not in TABLES[wildcards.run]]
    if unknown:
        stop(
            f"accuracy.records: '{unknown[0]}' is not in {cfg(wildcards)['records_table']}; "
            f"expected names from {', '.join(TABLES[wildcards.run])}"
        )
    return wanted


def accuracy_curves(wildcards, ending=""):
    """IDA tables of the study, or their ensembles."""
    settings = cfg(wildcards)["accuracy"]
    return [
        f"results/{wildcards.run}/ida/{model}/{record}_{direction}{ending}.csv"
        for model in settings["models"]
        for record in accuracy_records(wildcards)
        for direction in settings["directions"]
    ]


def accuracy_motions(wildcards):
    """Floor motions of the study's records."""
    n = cfg(wildcards)["smdof"]["n_dof"]
    return [
        f"results/{wildcards.run}/smdof/{record}_{n}dof.csv"
        for record in accuracy_records(wildcards)
    ]


def energy_histories(wildcards):
    """Balanced runs of the study: every model and record, in its first direction."""
    settings = cfg(wildcards)["accuracy"]
    return [
        f"results/{wildcards.run}/energy/{model}/{record}_{settings['directions'][0]}"
        f"_{settings['energy_share']:g}.csv"
        for model in settings["energy_models"]
        for record in accuracy_records(wildcards)
    ]


def accuracy_results(run):
    """What the target makes for one run."""
    names = ("speed_accuracy", "stability", "energy_balance")
    return [
        *(f"results/{run}/tables/{name}.csv" for name in (*names, "ensemble_members")),
        *(f"results/{run}/figures/{name}.png" for name in (*names, "chaos")),
    ]
