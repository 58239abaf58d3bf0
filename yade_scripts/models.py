"""Which assembly builds the scene of a model, so that entry points need not know."""

from . import facade, interlocking

SINGLE_BLOCK = ("free", "W1", "W1c", "W2", "W2c")


def build_scene(job):
    """Build the scene of a job.

    Parameters
    ----------
    job : dict
        A scene file: model, beta_s and the configuration's sections.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For an unknown model.
    """
    if job["model"] == "W3":
        return interlocking.interlocking_scene(job, job["beta_s"])
    return facade.facade_scene(job, job["model"], job["beta_s"])


def numerics(job):
    """Section numerics with the step that belongs to the model."""
    section = dict(job["numerics"])
    if job["model"] == "W3":
        section["step_fraction"] = job["w3"]["step_fraction"]
    return section


def motion_columns(scene, columns):
    """Add the motions between floors that a scene needs.

    Parameters
    ----------
    scene : Scene
        Its note "motions" holds, by name, the weights of the columns.
    columns : dict of str to ndarray
        "ground", "floor1", … [m/s²].

    Returns
    -------
    dict of str to ndarray

    Raises
    ------
    ValueError
        If a floor is missing.
    """
    found = dict(columns)
    for name, weights in scene.notes.get("motions", {}).items():
        missing = [column for column in weights if column not in columns]
        if missing:
            raise ValueError(f"the motion file has no column for {', '.join(missing)}")
        found[name] = sum(weight * columns[column] for column, weight in weights.items())
    return found
