"""A tested wall as a case: its stiffness and damping from what its specimen states.

Nothing here is set by a measured displacement: E or a spring follows from the first period, β from
a share of critical damping, a law, or as it is stated.
"""

import copy
import math

from rocking.configuration.config import ConfigError, resolve
from rocking.configuration.study import as_in_the_study

SECTIONS = ("facade", "return_wall", "smdof", "numerics")
E_KEY = "facade.e_mpa"
FITTED = {E_KEY: (1.0, 1e7), "floors.stiffness_kn_m": (1.0, 1e9)}  # what a period may set, within


def case(specimen, changes=(), height_m=None):
    """A variant of a specimen as a case file, its parameters found; see `models.build_scene`.

    Changes are by dotted key of a section ("facade.friction_deg"), of every floor
    ("floors.load_kn"), or "damping"; `height_m` is that of a block, where they differ from run to
    run.
    """
    from rocking.mechanics.blocks import weakest_hinge

    given, changes = copy.deepcopy(specimen["sections"]), dict(changes)
    damping = changes.pop("damping", specimen["damping"])
    for path, value in changes.items():
        section, _, key = path.partition(".")
        rows = given["facade"]["floors"] if section == "floors" else [given.setdefault(section, {})]
        for row in rows:
            row[key] = value
    if height_m is not None:
        given["facade"]["height_m"] = height_m
    resolved = resolve({**as_in_the_study(given), "models": ["W1"]})
    sections = {key: resolved[key] for key in SECTIONS}
    facade = sections["facade"]
    if facade["hinges_m"] == "weakest":
        facade["hinges_m"] = [weakest_hinge(facade)]
    sections |= {"model": specimen["model"], "beta_s": 0.0}
    sections["observed_m"] = specimen["observed"].get("height_m")
    if period := specimen.get("first_period_s"):
        fit_period(sections, period, specimen.get("fitted", E_KEY))
    sections["beta_s"] = beta_for(sections, damping)
    return sections


def walls_test(case, name, motion):
    """A case under one motion as it is, in the form that YADE's command `walls` takes."""
    entry = {key: case[key] for key in ("model", "beta_s", "observed_m")}
    entry["config"] = {key: case[key] for key in SECTIONS}
    return {**entry, "factor": 1.0, "id": name, "motion": motion}


def planar_step(planar, numerics):
    """Time step [s] that a specimen states, for the planar solver; None if it states none.

    A fraction is one of the largest step at which that solver is stable, as YADE's is of its own.
    """
    from rocking.solver import stable_step

    if numerics["step_s"] or not numerics["step_fraction"]:
        return numerics["step_s"]
    return numerics["step_fraction"] * stable_step(planar)


def first_frequency(job):
    """Lowest circular frequency of an assembled case, every joint closed [rad/s]."""
    from yade_scripts.model.models import build_scene
    from yade_scripts.model.stiffness import modes

    return float(modes(build_scene(job))[0][0])


def fit_period(job, period_s, path=E_KEY):
    """Set what one key of FITTED says so that the assembled case has a first period; in place.

    ConfigError if no value of it has that period, as where another part alone is too soft.
    """
    from scipy.optimize import brentq

    if path not in FITTED:
        raise ConfigError(f"fitted = {path}: expected {' or '.join(FITTED)}")
    row = job["facade"] if path == E_KEY else job["facade"]["floors"][0]
    key = path.rpartition(".")[2]

    def excess(log_value):
        row[key] = math.exp(log_value)
        return math.log(2.0 * math.pi / first_frequency(job) / period_s)

    low, high = (math.log(value) for value in FITTED[path])
    if not excess(low) > 0.0 > excess(high):
        raise ConfigError(f"first_period_s = {period_s:g}: expected one that some {path} gives (s)")
    row[key] = math.exp(brentq(excess, low, high, xtol=1e-10))


def bounce_frequency(job):
    """Circular frequency √(jkn/(ρh)) of the wall's bounce on its base [rad/s]."""
    from yade_scripts.model.facade import joint_stiffness

    facade = job["facade"]
    return math.sqrt(joint_stiffness(job)[0] / (facade["density_kg_m3"] * facade["height_m"]))


def beta_for(job, damping):
    """β [s]: stated, 2ζ/ω of the first mode or of the bounce on the base, or by a law of β.

    `damping` has a key of `validation.DAMPING`; `first_mode` and `bounce` are ζ.
    """
    from rocking.mechanics.beta import beta_for as beta_by_law

    ((key, value),) = damping.items()
    if key == "beta_s":
        return float(value)
    if key == "law":
        return beta_by_law({**job, "damping": {"law": value}})
    omega = {"first_mode": first_frequency, "bounce": bounce_frequency}[key]
    return 2.0 * float(value) / omega(job)


def cases(experiment):
    """Cases of an experiment by variant; of free rocking by variant and height."""
    variants = experiment.specimen["variants"].items()
    if experiment.specimen["kind"] == "shake_table":
        return {name: case(experiment.specimen, changes) for name, changes in variants}
    return {
        f"{name}|{height_m:g}": case(experiment.specimen, changes, float(height_m))
        for name, changes in variants
        for height_m in experiment.runs["height_m"].unique()
    }
