# Which files the rules need and a run consists of; functions only.


def record_row(wildcards):
    """Row of the records table."""
    return TABLES[wildcards.run][wildcards.record]


def record_file(wildcards):
    """The accelerogram's file; nothing for a surrogate."""
    return record_row(wildcards).path or []


def surrogate_parameters(wildcards):
    """File of the surrogates' parameters, for a record without a file of its own."""
    if record_row(wildcards).path is not None:
        return []
    return surrogates_for(table_path(cfg(wildcards))) or []


def record_facts(wildcards):
    """Provenance files of all records of a run."""
    return [f"results/{wildcards.run}/records/{r}.json" for r in RECORDS[wildcards.run]]


def ida_motion(wildcards):
    """Floor motions of a job's record."""
    n = cfg(wildcards)["smdof"]["n_dof"]
    return f"results/{wildcards.run}/smdof/{wildcards.record}_{n}dof.csv"


def ida_tables(run):
    """IDA tables of a run, by model, record and direction."""
    resolved = RUNS[run]
    return [
        f"results/{run}/ida/{model}/{record}_{direction}.csv"
        for model in resolved["models"]
        for record in RECORDS[run]
        for direction in resolved["directions"]
    ]


def ida_curves(dag):
    """Table, journal and number of runs of every curve of a DAG, for its progress."""
    curves = []
    for job in dag.jobs:
        if job.rule.name in ("ida", "reduction_ida"):
            ida = cfg(job.wildcards)["ida"]
            runs = len(ida["grid_g"]) if ida["mode"] == "grid" else None
            curves.append((Path(job.output[0]), job.params.journal, runs))
    return curves


def ensemble_tables(run):
    """Ensemble tables of a run; none where config switches them off."""
    if RUNS[run]["ensemble"]["enabled"] == "off":
        return []
    return [path.replace(".csv", "_ensemble.csv") for path in ida_tables(run)]


def sensitivity_tables(run):
    """Sensitivity tables of a run, made by the same jobs as the ensembles."""
    return [
        path.replace("_ensemble.csv", "_sensitivity.csv")
        for path in ensemble_tables(run)
    ]


def static_curves(run):
    """Pushover curves behind Figure 9: of the models that have one of their own."""
    models = [m for m in ("W1", "W1c", "W3") if m in RUNS[run]["models"]]
    return [f"results/{run}/pushover/{m}.csv" for m in models]


def yade_modules():
    """Modules of every run inside YADE."""
    return module(*(f"yade_scripts/{name}.py" for name in PHYSICS))


def main_results(run):
    """What the main job makes for one run."""
    figures = [f"record_{r}" for r in RECORDS[run]]
    figures += [f"floor_motions_{r}" for r in RECORDS[run]]
    figures += ["fig09_ida"]
    return [
        f"results/{run}/tables/records.csv",
        f"results/{run}/tables/ida_collapse.csv",
        *(f"results/{run}/figures/{name}.png" for name in figures),
    ]
