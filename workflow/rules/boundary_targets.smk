# Files of pushover, pictures and claims; functions only.
from rocking.pushover import RULES as HEADER_RULES
from rocking.pushover import VARIANTS as W3_VARIANTS


def picture_record(run):
    """Record that the pictures of a run show."""
    names = RECORDS[run]
    return RUNS[run]["pictures"]["record"] or names[min(1, len(names) - 1)]


def picture_motion(wildcards):
    """Floor motions of that record."""
    n = cfg(wildcards)["smdof"]["n_dof"]
    return f"results/{wildcards.run}/smdof/{picture_record(wildcards.run)}_{n}dof.csv"


def boundary_results(run):
    """Everything about boundary conditions; IDA of the models of the configuration."""
    names = ["fig07_models", "fig08_w3", "fig09_ida", "w3_sensitivity"]
    return [
        f"results/{run}/tables/pushover.csv",
        f"results/{run}/tables/claims.csv",
        *(f"results/{run}/figures/{name}.png" for name in names),
        *(f"results/{run}/figures/collapse_{model}.gif" for model in ("W2", "W3")),
    ]


def pushover_curves(run):
    """Capacity curves of a run."""
    return [
        f"results/{run}/pushover/{model}.csv"
        for model in RUNS[run]["pushover"]["models"]
    ]


def variant_files(run, pattern, names=tuple(W3_VARIANTS)):
    """Files of the variants of W3."""
    return [f"results/{run}/w3/{pattern.format(name)}" for name in names]
