"""Which wall an assessment takes: courses, or the study's rigid block; and the range of its β."""

from rocking.mechanics.beta import EQ5_MODULUS_MPA, EQ5_THICKNESS_M

from studies.assess.catalogue import SAY
from yade_scripts.model.facades import STUDY

BLOCK_WALL, COURSES_WALL = "one rigid block on E/h", "four elastic courses"  # in tables
WALL = {True: BLOCK_WALL, False: COURSES_WALL}  # the other wall, by whether it has courses
WALL_KEYS = {BLOCK_WALL: "block", COURSES_WALL: "courses"}
BETA = "beta_s"  # key of the sensitivity to contact damping


def named(facade, say=SAY):
    """The wall of a `Facade` in words, to end a sentence that begins with the façade."""
    if facade.courses:
        return say("verdict.wall.courses", courses=facade.courses)
    if facade.base_stiffness_pa_m is not None:
        return say("verdict.wall.stated")
    if facade.base == STUDY:
        return say("verdict.wall.even")
    return say("verdict.wall.edges", base=facade.base)


def beyond_law(facade, law):
    """What of a `Facade` lies outside of what eq. 5 was fitted to: keys of the page, and values."""
    if law != "eq5":
        return []
    every = (
        ("beyond_thick", "thickness_m", EQ5_THICKNESS_M),
        ("beyond_stiff", "e_mpa", EQ5_MODULUS_MPA),
    )
    return [
        (key, {name: value, "low": low, "high": high})
        for key, name, (low, high) in every
        if not low <= (value := getattr(facade, name)) <= high
    ]


def ranges_of(sensitivity, key):
    """Medians of a sensitivity's ratios by factor of a key: [(factor, median)]."""
    rows = sensitivity[sensitivity["key"] == key].dropna(subset=["ratio"])
    return [(factor, float(part["ratio"].median())) for factor, part in rows.groupby("factor")]
