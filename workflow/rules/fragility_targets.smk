# What `fragility` and `capacity_reduction` make and read; functions only.


def fragility_results(run):
    """Everything the target `fragility` makes for one run."""
    names = ("fragility", "intensity_measures")
    tables = [f"results/{run}/tables/{name}.csv" for name in names]
    return tables + [f"results/{run}/figures/{name}.png" for name in names]


def reduction_results(run):
    """Everything the target `capacity_reduction` makes for one run."""
    name = "capacity_reduction"
    return [f"results/{run}/tables/{name}.csv", f"results/{run}/figures/{name}.png"]


def reduction_facts(wildcards):
    """Peak floor accelerations of every case and record."""
    settings = cfg(wildcards)["capacity_reduction"]
    return [
        f"results/{wildcards.run}/capacity_reduction/T{t1:g}_below{below}/{record}.json"
        for t1 in settings["periods_s"]
        for below in settings["masses_below"]
        for record in RECORDS[wildcards.run]
    ]


def reduction_curves(wildcards):
    """W2 curves of every case, record and direction."""
    directions = cfg(wildcards)["directions"]
    return [
        path.replace(".json", f"_{direction}.csv")
        for path in reduction_facts(wildcards)
        for direction in directions
    ]


def reduction_reference(wildcards):
    """W1 curves of every record and direction."""
    return [
        f"results/{wildcards.run}/ida/W1/{record}_{direction}.csv"
        for record in RECORDS[wildcards.run]
        for direction in cfg(wildcards)["directions"]
    ]


wildcard_constraints:
    t1=r"[0-9.]+",
    below=r"\d+",
